#include <gtest/gtest.h>

#include "apps/deviations/deviation_runs.h"

namespace scattermeter::apps {
namespace {

TrueSetup deviating_mesh(const char* kind, const std::string& body, const DeviationDraw& draw) {
  const DeviationRun run{.kind = &deviation_named(kind), .body = body};
  TrueSetup setup = true_setup(stated_rig(run, 320), stated_mesh(body));
  run.kind->truth(setup, draw);
  return setup;
}

TEST(MeshDeviations, PlaceAndSize) {
  const TriangleMesh cube = stated_mesh("cube");
  const Box3d moved = bounds(deviating_mesh("mesh displaced in y", "cube", {3, -1, 1}).mesh);
  EXPECT_NEAR((moved.center_mm() - bounds(cube).center_mm() - Eigen::Vector3d(0, -3, 0)).norm(), 0,
              1e-12);
  const Box3d scaled = bounds(deviating_mesh("mesh scaled", "cube", {5, 1, 1}).mesh);
  EXPECT_NEAR((scaled.size_mm() - Eigen::Vector3d::Constant(21.0)).norm(), 0, 1e-12);
  const Box3d high = bounds(deviating_mesh("mesh stretched in z", "cube", {5, -1, 1}).mesh);
  EXPECT_NEAR((high.size_mm() - Eigen::Vector3d(20, 20, 19)).norm(), 0, 1e-12);
  // A square of side a, turned by 10 degrees: a (cos + sin) wide.
  const Box3d turned = bounds(deviating_mesh("mesh turned about z", "cube", {10, 1, 1}).mesh);
  EXPECT_NEAR(turned.size_mm().x(), 20 * 1.158456, 1e-4);
  EXPECT_NEAR(turned.size_mm().z(), 20, 1e-12);
}

TEST(MeshDeviations, Shape) {
  EXPECT_NEAR(signed_volume_mm3(deviating_mesh("other proportions", "cube", {15, 1, 1}).mesh), 8000,
              1e-6);
  EXPECT_LT(signed_volume_mm3(deviating_mesh("corner chipped off", "cube", {5, 1, 1}).mesh), 7990);
  EXPECT_LT(signed_volume_mm3(deviating_mesh("edges bevelled", "pyramid", {0.4, 1, 1}).mesh),
            signed_volume_mm3(stated_mesh("pyramid")));
  EXPECT_GT(deviating_mesh("another body", "cube", {1, 1, 1}).mesh.triangles.size(), 1000U);
  EXPECT_EQ(deviating_mesh("another body", "sphere", {1, 1, 1}).mesh.triangles.size(), 12U);
}

}  // namespace
}  // namespace scattermeter::apps
