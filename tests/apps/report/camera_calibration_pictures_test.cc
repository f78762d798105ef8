#include "apps/report/camera_calibration_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/made_camera.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// The longest residual, 0.5 px, is to span a twelfth of 480 px at most: 80 times, rounded to 50.
TEST(CameraCalibrationPictures, ResidualsAreMagnified) {
  const TemporaryFolder folder;
  write_plot(camera_residual_plot(made_camera().calibration), folder / "residuals.svg");
  const std::string svg = slurp(folder / "residuals.svg");
  EXPECT_THAT(svg, HasSubstr("Residuals x 50: rms 0.125 px, worst 0.500 px"));
  EXPECT_THAT(svg, HasSubstr(">left out<"));
}

TEST(CameraCalibrationPictures, CoverageNamesItsViews) {
  const TemporaryFolder folder;
  write_plot(camera_coverage_plot(made_camera().calibration), folder / "coverage.svg");
  const std::string svg = slurp(folder / "coverage.svg");
  EXPECT_THAT(svg, HasSubstr("Corners in 3 views: 64 % of 5 x 5 fields of the frame covered"));
  for (const char* view : {">a.dng<", ">b.dng<", ">c.dng<"}) EXPECT_THAT(svg, HasSubstr(view));
}

}  // namespace
}  // namespace scattermeter::apps
