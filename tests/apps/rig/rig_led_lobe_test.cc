#include "apps/rig/rig_led_lobe.h"

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

TEST(RigLedLobe, WhatIsWrittenIsReadBack) {
  for (const char* fields :
       {"angle_deg: [0, 35, 60, 90], relative: [0.7, 1, 0.5, 0.125]",
        "angle_deg: [-50, 0, 90], relative_x: [0, 1, 0.1], relative_y: [0, 1, 0.2], "
        "x_axis: [1, 2, 0]"}) {
    const auto lobe = lobe_of(fields);
    YAML::Emitter out;
    out.SetDoublePrecision(17);
    out << YAML::BeginMap << YAML::Key << "lobe" << YAML::Value;
    emit_lobe(out, *lobe);
    out << YAML::EndMap;
    const auto again = read_lobe(yaml_text(out.c_str()).at("lobe"), -Eigen::Vector3d::UnitZ());
    ASSERT_EQ(again->angles_rad().size(), lobe->angles_rad().size());
    for (std::size_t i = 0; i < lobe->angles_rad().size(); ++i) {
      EXPECT_NEAR(again->angles_rad()[i], lobe->angles_rad()[i], 1e-15);
    }
    EXPECT_EQ(again->in_x(), lobe->in_x());
    EXPECT_EQ(again->in_y(), lobe->in_y());
    EXPECT_NEAR((again->x_axis() - lobe->x_axis()).norm(), 0.0, 1e-15);
  }
}

TEST(RigLedLobe, NamesMistakes) {
  EXPECT_THAT(lobe_refused("relative: [1, 0]"), HasSubstr("lobe.angle_deg: is missing"));
  EXPECT_THAT(lobe_refused("angle_deg: [0, 90]"), HasSubstr("lobe.x_axis: is missing"));
  EXPECT_THAT(lobe_refused("angle_deg: [0, 91], relative: [1, 0]"), HasSubstr("91"));
  EXPECT_THAT(lobe_refused("angle_deg: [0, 90], relative: [1, -0.1]"), HasSubstr("-0.1"));
  EXPECT_THAT(lobe_refused("angle_deg: [0, 60], relative: [1, 0.5]"),
              HasSubstr("rig.yaml:1: lobe: expected angles up to 90 degrees"));
  EXPECT_THAT(lobe_refused("angle_deg: [0, 90], relative: [1, 0], x_axis: [1, 0, 0]"),
              HasSubstr("lobe.x_axis: belongs to two planes"));
  EXPECT_THAT(lobe_refused("angle_deg: [0, 90], relative_x: [1, 0], relative_y: [1, 0], "
                           "x_axis: [0, 0.01, 1]"),
              HasSubstr("lobe.x_axis: expected a direction across the LED's axis"));
}

}  // namespace
}  // namespace scattermeter::apps
