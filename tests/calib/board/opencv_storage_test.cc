#include "calib/board/opencv_storage.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/board/opencv_quiet.h"
#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::calib {
namespace {

TEST(OpencvStorage, OpensMapsAndReadsMatrices) {
  const TemporaryFolder folder;
  cv::FileStorage out(folder / "a.yaml", cv::FileStorage::WRITE);
  out << "m" << cv::Mat(cv::Matx22f(1, 2, 3, 4)) << "n" << 7 << "rgb" << cv::Mat(2, 2, CV_8UC3);
  out.release();
  const OpencvQuiet quiet;
  const cv::FileStorage in = open_storage(folder / "a.yaml");
  const cv::Mat m = read_storage_matrix("m", in["m"]);
  EXPECT_EQ(m.type(), CV_64F);
  EXPECT_EQ(m.at<double>(1, 0), 3);
  EXPECT_THROW(read_storage_matrix("n", in["n"]), InputError);
  EXPECT_THROW(read_storage_matrix("rgb", in["rgb"]), InputError);
}

// Without taking the 80 GB that it claims.
TEST(OpencvStorage, RefusesAMatrixLargerThanItsValues) {
  const TemporaryFolder folder;
  const OpencvQuiet quiet;
  for (const char* rows : {"2147483647", "-3", "2", ")"}) {
    std::ofstream(folder / "a.yaml") << "%YAML:1.0\n---\nm: !!opencv-matrix\n   rows: " << rows
                                     << "\n   cols: 5\n   dt: d\n   data: [ 1., 2., 3., 4., 5. ]\n";
    const cv::FileStorage in = open_storage(folder / "a.yaml");
    EXPECT_THROW(read_storage_matrix("m", in["m"]), InputError) << rows;
  }
}

TEST(OpencvStorage, NamesTheFile) {
  const TemporaryFolder folder;
  const OpencvQuiet quiet;
  EXPECT_THROW(open_storage(folder / "missing.yaml"), InputError);
  std::ofstream(folder / "empty.yaml") << "\n";
  EXPECT_THROW(open_storage(folder / "empty.yaml"), InputError);
  // OpenCV's parser leaves this one by std::length_error.
  std::ofstream(folder / "key.yaml") << "%YAML:1.0\n---\na: 1\n   :a[ tda -0.1, 0.05 ]\n";
  EXPECT_THROW(open_storage(folder / "key.yaml"), InputError);
  // It would not come back from this one.
  std::ofstream(folder / "two.yaml") << "%YAML:1.0\n---%YAML:1.0\n\n\nc---\nimag_a%YAiML";
  EXPECT_THROW(open_storage(folder / "two.yaml"), InputError);
  std::ofstream(folder / "text.yaml") << "no map at all";
  EXPECT_THROW(open_storage(folder / "text.yaml"), InputError);
}

}  // namespace
}  // namespace scattermeter::calib
