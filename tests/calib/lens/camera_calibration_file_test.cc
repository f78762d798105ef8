#include "calib/lens/camera_calibration_file.h"

#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "calib/lens/intrinsics_file.h"
#include "core/base/input_error.h"
#include "tests/fixtures/calib/board_scene.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

CameraCalibration calibration() {
  std::vector<BoardView> views = with_noise(board_scene(board_lens(), 8, 1).views, 0.1, 1);
  views[3].corners.resize(4);
  views[2].corners[10].image_px.x() += 5;
  return calibrate_camera(views, 640, 480);
}

std::string error_of(std::string text, const std::string& from, const std::string& to) {
  const TemporaryFolder folder;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  std::ofstream(folder / "camera.yaml") << text;
  try {
    read_camera_calibration_file(folder / "camera.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CameraCalibrationFile, ReadsBackWhatItWrote) {
  const CameraCalibration c = calibration();
  ASSERT_EQ(c.status, CameraCalibrationStatus::kOk);
  const TemporaryFolder folder;
  const std::string path = folder / "camera.yaml";
  std::ofstream(path) << camera_calibration_text(c, {"made by a test", "a board"});
  const CameraCalibrationFile read = read_camera_calibration_file(path);
  EXPECT_EQ(read.intrinsics.width_px, 640);
  EXPECT_EQ(read.intrinsics.height_px, 480);
  EXPECT_EQ(lens_parameters(read.intrinsics), lens_parameters(c.intrinsics));
  EXPECT_EQ(read.intrinsics.distortion, c.intrinsics.distortion);
  EXPECT_EQ(read.parameters, c.parameters);
  EXPECT_EQ(read.covariance, c.covariance);
  EXPECT_EQ(read.rms_px, c.rms_px);
  EXPECT_EQ(read.worst_px, c.worst_px);
  EXPECT_EQ(read.noise_std_px, c.noise_std_px);
  ASSERT_EQ(read.views.size(), 7U);
  EXPECT_EQ(read.views[3], "view4");
  ASSERT_EQ(read.residuals.size(), c.residuals.size());
  EXPECT_EQ(read.residuals[100].residual_px, c.residuals[100].residual_px);
  EXPECT_EQ(read.residuals[100].view_idx, c.residuals[100].view_idx);
  // The rig's door to it.
  EXPECT_EQ(read_intrinsics(path).fx_px, c.intrinsics.fx_px);
  // OpenCV's own reader, what was left out and why.
  cv::FileStorage storage(path, cv::FileStorage::READ);
  cv::Mat k;
  storage["camera_matrix"] >> k;
  EXPECT_EQ(k.at<double>(0, 0), c.intrinsics.fx_px);
  const cv::FileNode top = storage["scattermeter_camera"];
  EXPECT_EQ(static_cast<std::string>(top["left_out"][0]["name"]), "view3");
  EXPECT_THAT(static_cast<std::string>(top["left_out"][0]["reason"]), HasSubstr("4 corners"));
  EXPECT_EQ(static_cast<std::string>(top["corners_left_out"][0]["view"]), "view2");
}

TEST(CameraCalibrationFile, NamesWhatIsWrong) {
  const std::string text = camera_calibration_text(calibration(), {});
  EXPECT_THAT(error_of(text, "cx_px", "dx_px"), HasSubstr("scattermeter_camera.parameters"));
  EXPECT_THAT(error_of(text, "version: 1", "version: 2"), HasSubstr("version"));
  EXPECT_THAT(error_of(text, "noise_std_px:", "other:"), HasSubstr("noise_std_px"));
  const std::size_t at = text.find("data: [", text.find("covariance:")) + 7;
  std::string broken = text;
  broken.insert(at, " -");
  const std::string first = text.substr(at, 8);
  EXPECT_THAT(error_of(text, "data: [" + first, "data: [ -" + first.substr(1)),
              HasSubstr("symmetric positive"));
  EXPECT_THROW(camera_calibration_text({}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
