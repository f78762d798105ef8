#include "apps/simulation/simulate_led_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/virtual_led_shots.h"
#include "capture/raw/raw_reader.h"
#include "tests/fixtures/apps/led_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

TEST(SimulateLedCalibration, FilesAreTheVirtualShots) {
  const TemporaryFolder folder;
  Rig rig = tiny_led_rig();
  SimulateOptions options;
  options.seed = 9;
  const std::vector<std::string> paths =
      simulate_led_calibration(rig, folder.path(), options, nullptr);
  EXPECT_THAT(paths, ::testing::ElementsAre(folder / "spheres_led1.dng", folder / "low_led1.dng",
                                            folder / "high_led1.dng"));
  const VirtualLedShots shots(rig, true);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const capture::RawFrame read = capture::read_raw(paths[i]);
    EXPECT_TRUE(read.samples == shots.frame(i, 9).samples) << paths[i];
    EXPECT_NEAR(read.exposure_s, shots.exposure_s(i), 1e-6);
  }
  rig.calibration.led.reset();
  EXPECT_TRUE(simulate_led_calibration(rig, folder.path(), options, nullptr).empty());
}

}  // namespace
}  // namespace scattermeter::apps
