#include "apps/rig/rig_led_lobe.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

std::shared_ptr<const LobeTable> lobe_of(const std::string& fields) {
  return read_lobe(yaml_text("lobe: {" + fields + "}\n").at("lobe"), -Eigen::Vector3d::UnitZ());
}
std::string lobe_refused(const std::string& fields) {
  return refusal_of([&] { lobe_of(fields); });
}

TEST(RigLedLobe, RoundOne) {
  const auto lobe = lobe_of("angle_deg: [0, 60, 90], relative: [1, 0.5, 0]");
  EXPECT_TRUE(lobe->is_round());
  EXPECT_NEAR(lobe->value<double>(-Eigen::Vector3d::UnitZ(), {std::sqrt(0.75), 0, -0.5}), 0.5,
              1e-12);
}

TEST(RigLedLobe, TwoPlanes) {
  const auto lobe = lobe_of(
      "angle_deg: [-50, 0, 90], relative_x: [0, 1, 0.1], relative_y: [0, 1, 0.2], "
      "x_axis: [0, 2, 0]");
  EXPECT_FALSE(lobe->is_round());
  EXPECT_EQ(lobe->x_axis(), Eigen::Vector3d::UnitY());
  EXPECT_EQ(lobe->in_y(), (std::vector<double>{0, 1, 0.2}));
}

TEST(RigLedLobe, NamesMistakes) {
  EXPECT_THAT(lobe_refused("relative: [1, 0]"), HasSubstr("lobe.angle_deg: is missing"));
  EXPECT_THAT(lobe_refused("angle_deg: [0, 90]"), HasSubstr("lobe.x_axis: is missing"));
  EXPECT_THAT(lobe_refused("angle_deg: [0, 91], relative: [1, 0]"), HasSubstr("91"));
  EXPECT_THAT(lobe_refused("angle_deg: [0, 90], relative: [1, -0.1]"), HasSubstr("-0.1"));
  EXPECT_THAT(lobe_refused("angle_deg: [0, 60], relative: [1, 0.5]"),
              HasSubstr("rig.yaml:1: lobe: expected angles up to 90 degrees"));
  EXPECT_THAT(lobe_refused("angle_deg: [0, 90], relative: [1, 0], x_axis: [1, 0, 0]"),
              HasSubstr("lobe.x_axis: is for a lobe in two planes"));
  EXPECT_THAT(lobe_refused("angle_deg: [0, 90], relative_x: [1, 0], relative_y: [1, 0], "
                           "x_axis: [0, 0.01, 1]"),
              HasSubstr("lobe.x_axis: expected a direction across the LED's axis"));
}

}  // namespace
}  // namespace scattermeter::apps
