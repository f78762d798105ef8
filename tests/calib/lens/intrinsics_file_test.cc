#include "calib/lens/intrinsics_file.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::calib {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string matrix(const std::string& name, int rows, int cols, const std::string& data) {
  return name + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
         "\n   cols: " + std::to_string(cols) + "\n   dt: d\n   data: [ " + data + " ]\n";
}

const char* const kHead = "%YAML:1.0\n---\n";
const char* const kSize = "image_width: 640\nimage_height: 480\n";
const char* const kK = "500., 0., 319.5, 0., 510., 239.5, 0., 0., 1.";

// The message of the InputError that reading `text` throws, checked to start with the path; OpenCV
// must not have printed anything.
std::string error_of(const std::string& text) {
  const TemporaryFolder folder;
  const std::string path = folder / "camera.yaml";
  std::ofstream(path) << text;
  std::string message;
  ::testing::internal::CaptureStderr();
  try {
    read_intrinsics(path);
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << text;
  EXPECT_THAT(message, StartsWith(path + ": ")) << text;
  return message;
}

// What OpenCV's own writer makes of it, in each of its formats.
TEST(ReadIntrinsics, ReadsWhatFileStorageWrites) {
  const TemporaryFolder folder;
  for (const char* name : {"a.yaml", "a.xml", "a.json"}) {
    const std::string path = folder / name;
    cv::FileStorage out(path, cv::FileStorage::WRITE);
    out << "calibration_time"
        << "some day"
        << "image_width" << 3872 << "image_height" << 2592;
    out << "camera_matrix" << cv::Mat(cv::Matx33d(9836.25, 0, 1935.5, 0, 9830.5, 1295.25, 0, 0, 1));
    out << "distortion_coefficients" << (cv::Mat_<double>(5, 1) << -0.1, 0.2, 1e-3, -2e-4, 0.05);
    out.release();
    const CameraIntrinsics read = read_intrinsics(path);
    EXPECT_EQ(read.width_px, 3872);
    EXPECT_EQ(read.height_px, 2592);
    EXPECT_DOUBLE_EQ(read.fx_px, 9836.25);
    EXPECT_DOUBLE_EQ(read.fy_px, 9830.5);
    EXPECT_DOUBLE_EQ(read.cx_px, 1935.5);
    EXPECT_DOUBLE_EQ(read.cy_px, 1295.25);
    EXPECT_THAT(read.distortion, ElementsAre(-0.1, 0.2, 1e-3, -2e-4, 0.05));
  }
}

TEST(ReadIntrinsics, OtherNamesAndForms) {
  const TemporaryFolder folder;
  const std::string path = folder / "camera.yaml";
  // Single precision, one row, 14 terms of which the last six are zero.
  cv::FileStorage out(path, cv::FileStorage::WRITE);
  out << "K" << cv::Mat(cv::Matx33f(500, 0, 319.5, 0, 510, 239.5, 0, 0, 1));
  cv::Mat_<double> d = cv::Mat_<double>::zeros(1, 14);
  d(0) = -0.25;
  d(7) = 0.5;
  out << "D" << d << "image_size" << std::vector<int>{640, 480};
  out.release();
  const CameraIntrinsics read = read_intrinsics(path);
  EXPECT_EQ(read.width_px, 640);
  EXPECT_EQ(read.height_px, 480);
  EXPECT_DOUBLE_EQ(read.fy_px, 510);
  EXPECT_THAT(read.distortion, ElementsAre(-0.25, 0, 0, 0, 0, 0, 0, 0.5));

  std::ofstream(path) << kHead << kSize << matrix("cameraMatrix", 3, 3, kK);
  EXPECT_THAT(read_intrinsics(path).distortion, ElementsAre());
}

TEST(ReadIntrinsics, NoFileNoFormat) {
  EXPECT_THROW(
      {
        try {
          read_intrinsics("/nowhere/camera.yaml");
        } catch (const InputError& error) {
          EXPECT_THAT(error.what(), StartsWith("/nowhere/camera.yaml: no such file"));
          throw;
        }
      },
      InputError);
  const TemporaryFolder folder;
  EXPECT_THROW(read_intrinsics(folder.path()), InputError);
  EXPECT_THAT(error_of(""), HasSubstr("empty"));
  EXPECT_THAT(error_of("P6 3 3 255 not a text of that kind"), HasSubstr("expected YAML"));
  EXPECT_THAT(error_of("%YAML:1.0\n---\nK: [1, 2\n  : }"), HasSubstr("expected YAML"));
  EXPECT_THAT(error_of("\nmaterial: PE\n- a\n"), HasSubstr("begins with: material: PE"));
  EXPECT_THAT(error_of("{\"K\": "), HasSubstr("expected YAML"));
  EXPECT_THAT(error_of("<?xml version=\"1.0\"?>\n<opencv_storage>\n<K"),
              HasSubstr("expected YAML"));
}

TEST(ReadIntrinsics, CameraMatrix) {
  const std::string head = std::string(kHead) + kSize;
  EXPECT_THAT(error_of(head), HasSubstr("has no camera_matrix or cameraMatrix or K"));
  EXPECT_THAT(error_of(head + "camera_matrix: 5\n"),
              AllOf(HasSubstr("camera_matrix"), HasSubstr("opencv-matrix")));
  EXPECT_THAT(error_of(head + matrix("K", 3, 4, "1,2,3,4,5,6,7,8,9,10,11,12")),
              AllOf(HasSubstr(": K: "), HasSubstr("3 x 3"), HasSubstr("3 x 4")));
  EXPECT_THAT(error_of(head + matrix("K", 3, 3, "1., 2.")), HasSubstr(": K: "));
  EXPECT_THAT(error_of(head + matrix("K", 3, 3, "500., 3., 1., 0., 500., 1., 0., 0., 1.")),
              HasSubstr("row 1, column 2 (pixels without skew), got 3"));
  EXPECT_THAT(error_of(head + matrix("K", 3, 3, "500., 0., 319.5, 0., .Nan, 239.5, 0., 0., 1.")),
              AllOf(HasSubstr("fy_px"), HasSubstr("nan")));
  EXPECT_THAT(error_of(head + matrix("K", 3, 3, "-5., 0., 319.5, 0., 510., 239.5, 0., 0., 1.")),
              AllOf(HasSubstr("fx_px"), HasSubstr("-5")));
}

TEST(ReadIntrinsics, Distortion) {
  const std::string head = kHead + (kSize + matrix("K", 3, 3, kK));
  EXPECT_THAT(error_of(head + matrix("D", 1, 3, "1., 2., 3.")),
              AllOf(HasSubstr(": D: "), HasSubstr("got 3")));
  EXPECT_THAT(error_of(head + matrix("distCoeffs", 2, 2, "1., 2., 3., 4.")),
              AllOf(HasSubstr(": distCoeffs: "), HasSubstr("2 x 2")));
  EXPECT_THAT(error_of(head + matrix("D", 1, 9, "1., 2., 3., 4., 5., 6., 7., 8., 9.")),
              HasSubstr("thin prism"));
  EXPECT_THAT(error_of(head + matrix("D", 1, 4, "1., .Inf, 3., 4.")), HasSubstr("term 2"));
}

TEST(ReadIntrinsics, ImageSize) {
  const std::string head = kHead + matrix("K", 3, 3, kK);
  EXPECT_THAT(error_of(head), HasSubstr("has no image_width"));
  EXPECT_THAT(error_of(head + "image_width: 640\n"), HasSubstr("has no image_height"));
  EXPECT_THAT(error_of(head + "image_width: -640\nimage_height: 480\n"),
              AllOf(HasSubstr("image_width: "), HasSubstr("got -640")));
  EXPECT_THAT(error_of(head + "image_width: 640\nimage_height: 480.5\n"),
              AllOf(HasSubstr("image_height: "), HasSubstr("got 480.5")));
  EXPECT_THAT(error_of(head + "image_width: wide\nimage_height: 480\n"), HasSubstr("\"wide\""));
  EXPECT_THAT(error_of(head + "image_size: [ 640 ]\n"), HasSubstr("image_size: expected two"));
}

}  // namespace
}  // namespace scattermeter::calib
