#include "apps/rig/rig_white_plane.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

constexpr const char* kLeastPlane = "size_mm: [60, 44]\nalbedo: [0.9, 0.92, 0.88]\n";

TEST(RigWhitePlane, ReadsEveryField) {
  const calib::WhitePlane plane = read_white_plane(
      yaml_text(std::string(kLeastPlane) +
                "origin_mm: [-30, -22, 15]\nx_axis: [0, 2, 0]\ny_axis: [-3, 0, 0]\n"
                "albedo_relative_std: 0.005\n"),
      0.02);
  EXPECT_EQ(plane.origin_mm, Eigen::Vector3d(-30, -22, 15));
  EXPECT_EQ(plane.x_axis, Eigen::Vector3d::UnitY());
  EXPECT_EQ(plane.y_axis, -Eigen::Vector3d::UnitX());
  EXPECT_EQ(plane.normal(), Eigen::Vector3d::UnitZ());
  EXPECT_EQ(plane.width_mm, 60.0);
  EXPECT_EQ(plane.height_mm, 44.0);
  EXPECT_EQ(plane.albedo[0], 0.9);
  EXPECT_EQ(plane.albedo[1], 0.92);
  EXPECT_EQ(plane.albedo[2], 0.88);
  EXPECT_EQ(plane.albedo_relative_std, 0.005);
}

TEST(RigWhitePlane, LiesInTheGroundAndIsAsWellKnownAsTheCallerSays) {
  const calib::WhitePlane plane = read_white_plane(yaml_text(kLeastPlane), 0.02);
  EXPECT_EQ(plane.origin_mm, Eigen::Vector3d::Zero());
  EXPECT_EQ(plane.normal(), Eigen::Vector3d::UnitZ());
  EXPECT_EQ(plane.albedo_relative_std, 0.02);
}

TEST(RigWhitePlane, NamesWhatIsWrong) {
  const auto refused = [](const std::string& text) {
    return refusal_of([&] { read_white_plane(yaml_text(text), 0.0); });
  };
  const std::string good = kLeastPlane;
  EXPECT_THAT(refused(good + "x_axis: [1, 0, 0]\ny_axis: [0.01, 1, 0]\n"),
              HasSubstr("not at right angles"));
  EXPECT_THAT(refused("size_mm: [60, 44]\nalbedo: [0.9, 1.01, 0.9]\n"),
              HasSubstr("albedo: expected albedos of at most 1"));
  EXPECT_EQ(refused("size_mm: [60, 44]\nalbedo: [1, 1, 1]\n"), "");
  EXPECT_THAT(refused("size_mm: [60, 0]\nalbedo: [1, 1, 1]\n"), HasSubstr("size_mm[1]"));
  EXPECT_THAT(refused("size_mm: [60]\nalbedo: [1, 1, 1]\n"), HasSubstr("size_mm"));
  EXPECT_THAT(refused("albedo: [1, 1, 1]\n"), HasSubstr("size_mm: is missing"));
  EXPECT_THAT(refused(good + "albedo_relative_std: -0.1\n"), HasSubstr("albedo_relative_std"));
}

}  // namespace
}  // namespace scattermeter::apps
