#include "apps/rig/rig_limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(RigLimits, HoldWithoutTheSection) {
  const RigLimits limits = read_limits(yaml_text("camera: {}\n"));
  EXPECT_EQ(limits.raw_megapixels, 400.0);
  EXPECT_EQ(limits.probe_megapixels, 64.0);
  EXPECT_EQ(limits.mesh_triangles, 2e7);
}

TEST(RigLimits, EachIsReadByItself) {
  const RigLimits raw = read_limits(yaml_text("limits: {raw_megapixels: 12.5}\n"));
  EXPECT_EQ(raw.raw_megapixels, 12.5);
  EXPECT_EQ(raw.probe_megapixels, 64.0);
  const RigLimits rest =
      read_limits(yaml_text("limits: {probe_megapixels: 3, mesh_triangles: 1000}\n"));
  EXPECT_EQ(rest.raw_megapixels, 400.0);
  EXPECT_EQ(rest.probe_megapixels, 3.0);
  EXPECT_EQ(rest.mesh_triangles, 1000.0);
}

TEST(RigLimits, RefusesWhatNoComputerCounts) {
  for (const char* bad : {"raw_megapixels: 0", "probe_megapixels: 2001", "mesh_triangles: 0.5",
                          "mesh_triangles: 3e9", "frames: 1"}) {
    EXPECT_THAT(refusal_of([&] { read_limits(yaml_text("limits: {" + std::string(bad) + "}\n")); }),
                HasSubstr("limits." + std::string(bad).substr(0, std::string(bad).find(':'))))
        << bad;
  }
}

TEST(RigLimits, AFrameAtTheLimitPasses) {
  RigLimits limits;
  limits.raw_megapixels = 1.0;
  EXPECT_EQ(refusal_of([&] { check_image_size(yaml_text("s: [1000, 1000]").at("s"), limits); }),
            "");
  EXPECT_THAT(refusal_of([&] { check_image_size(yaml_text("s: [1001, 1000]").at("s"), limits); }),
              HasSubstr("more than the allowed 1 megapixels (limits.raw_megapixels"));
  // More than an int holds.
  limits.raw_megapixels = 2000.0;
  EXPECT_NE(refusal_of([&] { check_image_size(yaml_text("s: [100000, 100000]").at("s"), limits); }),
            "");
}

}  // namespace
}  // namespace scattermeter::apps
