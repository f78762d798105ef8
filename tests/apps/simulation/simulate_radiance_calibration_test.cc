#include "apps/simulation/simulate_radiance_calibration.h"

#include <gtest/gtest.h>

#include "apps/simulation/radiance_shots.h"
#include "capture/raw/raw_reader.h"
#include "tests/fixtures/apps/radiance_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

TEST(SimulateRadianceCalibration, FilesAreTheVirtualShots) {
  const TemporaryFolder folder;
  Rig rig = radiance_rig();
  SimulateOptions options;
  options.seed = 9;
  const std::vector<std::string> paths =
      simulate_radiance_calibration(rig, folder.path(), options, nullptr);
  const std::vector<calib::RadianceShot> listed = all_radiance_shots(*rig.calibration.radiance);
  ASSERT_EQ(paths.size(), listed.size());
  EXPECT_EQ(folder.entries(), static_cast<std::ptrdiff_t>(listed.size()));
  const RadianceShots shots(rig, true);
  for (std::size_t i = 0; i < paths.size(); i += 5) {
    EXPECT_EQ(paths[i], folder / listed[i].file);
    EXPECT_TRUE(capture::read_raw(paths[i]).samples == shots.frame(listed[i], 9).samples) << i;
  }
  rig.calibration.radiance.reset();
  EXPECT_TRUE(simulate_radiance_calibration(rig, folder.path(), options, nullptr).empty());
}

}  // namespace
}  // namespace scattermeter::apps
