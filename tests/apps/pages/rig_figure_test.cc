#include "apps/pages/rig_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/mesh/bodies.h"
#include "core/mesh/round_bodies.h"
#include "tests/fixtures/apps/html_check.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

double volume_ratio(const TriangleMesh& a, const TriangleMesh& b) {
  return signed_volume_mm3(a) / signed_volume_mm3(b);
}

TEST(RigFigure, AFewTrianglesAreCut) {
  const TriangleMesh cube = cube_mesh();
  const TriangleMesh drawn = drawable_mesh(cube);
  EXPECT_EQ(drawn.triangles.size(), 12U * 64U);
  EXPECT_NEAR(volume_ratio(drawn, cube), 1.0, 1e-12);
}

TEST(RigFigure, ManyTrianglesBecomeFewerOfTheSameShape) {
  const TriangleMesh sphere = sphere_mesh(6);
  ASSERT_GT(sphere.triangles.size(), 20'000U);
  const TriangleMesh drawn = drawable_mesh(sphere);
  EXPECT_LE(drawn.triangles.size(), 2500U);
  EXPECT_GT(drawn.triangles.size(), 1000U);
  EXPECT_NEAR(volume_ratio(drawn, sphere), 1.0, 0.03);
}

RigPlaces places() {
  RigPlaces out;
  const Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();
  out.cameras = {{"camera", {0, -100, 150.04}, {down, down, down, down}, {0.01, 0.02, 0.013}}};
  out.leds = {{"led <1>", {30, -60, 80}, down, 0.2}};
  out.bodies = {{"cube", cube_mesh()}};
  out.marks = {{-26, -14, 0}};
  out.plane_z_mm = -1.5;
  return out;
}

TEST(RigFigure, DataHoldsThePlaces) {
  const nlohmann::json data = nlohmann::json::parse(rig_data(places()));
  EXPECT_EQ(data.at("cameras").at(0).at("at"), nlohmann::json({0.0, -100.0, 150.04}));
  EXPECT_EQ(data.at("cameras").at(0).at("corners").size(), 4U);
  EXPECT_EQ(data.at("leds").at(0).at("axis"), nlohmann::json({0.0, 0.0, -1.0}));
  EXPECT_EQ(data.at("bodies").at(0).at("triangles").size(), 3U * 12U * 64U);
  EXPECT_EQ(data.at("marks"), nlohmann::json({{-26.0, -14.0, 0.0}}));
  EXPECT_TRUE(data.at("board").empty());
  EXPECT_EQ(data.at("plane_z"), -1.5);
}

TEST(RigFigure, TableSaysTheSameInWords) {
  const Html html = rig_figure(places());
  EXPECT_EQ(html_problem(html_document("t", html)), "");
  for (const char* text : {"0.0, -100.0, 150.0", ">0.02<", "led &lt;1&gt;", "30.0, -60.0, 80.0",
                           "axis 0.0, 0.0, -1.0", "mark 1", "extends over 20.0, 20.0, 20.0 mm"}) {
    EXPECT_THAT(html.markup, HasSubstr(text));
  }
}

}  // namespace
}  // namespace scattermeter::apps
