#include "apps/simulation/board_signal.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/fixtures/apps/overhead_view.h"

namespace scattermeter::apps {
namespace {

// 120 x 100 mm.
const calib::CalibrationBoard kSignalBoard = {calib::BoardKind::kChessboard, 6, 5, 20.0, 0.0, ""};

// To the next line between squares, mm.
double to_a_line(double x_mm) { return std::abs(x_mm - 20.0 * std::round(x_mm / 20.0)); }

// White 1, black 0.045, margin, surround, and 15 % less light at the right: pixel by pixel.
TEST(BoardSignal, IsThePrint) {
  const CameraView view = overhead_view(60, 50);
  const std::vector<float> signal = board_signal(view, kSignalBoard, 0.0);
  ASSERT_EQ(signal.size(), 240U * 200U);
  int black = 0, white = 0, margin = 0, surround = 0;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 240; ++x) {
      const Eigen::Vector3d p = overhead_point_mm(view, x, y);
      if (to_a_line(p.x()) < 1.0 || to_a_line(p.y()) < 1.0) continue;
      double expected = 0.25;
      if (p.x() > 0 && p.x() < 120 && p.y() > 0 && p.y() < 100) {
        // The upper left square is black.
        const int column = static_cast<int>(p.x() / 20.0);
        const int row = static_cast<int>((100.0 - p.y()) / 20.0);
        const bool is_black = (column + row) % 2 == 0;
        expected = (is_black ? 0.045 : 1.0) * (1.0 - 0.15 * p.x() / 120.0);
        (is_black ? black : white) += 1;
      } else if (p.x() > -20 && p.x() < 140 && p.y() > -20 && p.y() < 120) {
        expected = 1.0 - 0.15 * std::clamp(p.x() / 120.0, 0.0, 1.0);
        ++margin;
      } else {
        ++surround;
      }
      ASSERT_NEAR(signal[static_cast<std::size_t>(y * 240 + x)], expected, 2e-5) << p.transpose();
    }
  }
  // 18 x 18 pixels of each of the 15 black and 15 white squares.
  EXPECT_EQ(black, 15 * 18 * 18);
  EXPECT_EQ(white, 15 * 18 * 18);
  EXPECT_GT(margin, 5000);
  EXPECT_GT(surround, 10000);
}

// An edge within a pixel is a mean over its area.
TEST(BoardSignal, PixelsAreMeansOverTheirArea) {
  const CameraView view = overhead_view(60.25, 50);
  const std::vector<float> signal = board_signal(view, kSignalBoard, 0.0);
  // The pixel from 19.25 to 20.25 mm: three quarters of it lie before the line x = 20, in the black
  // square of the uppermost row.
  const int x = 79;
  const int y = 59;
  EXPECT_NEAR(overhead_point_mm(view, x, y).x(), 19.75, 1e-9);
  EXPECT_NEAR(overhead_point_mm(view, x, y).y(), 90.5, 1e-9);
  const double fall = 1.0 - 0.15 * 19.75 / 120.0;
  const std::size_t i = static_cast<std::size_t>(y) * 240U + static_cast<std::size_t>(x);
  EXPECT_NEAR(signal[i], (0.75 * 0.045 + 0.25) * fall, 1e-3);
  EXPECT_NEAR(signal[i - 1], 0.045 * fall, 1e-3);
  EXPECT_NEAR(signal[i + 1], fall, 2e-3);
}

// Blur takes no light away, and an edge is the Gaussian's integral.
TEST(BoardSignal, Blur) {
  const CameraView view = overhead_view(60, 50);
  const std::vector<float> sharp = board_signal(view, kSignalBoard, 0.0);
  const std::vector<float> soft = board_signal(view, kSignalBoard, 2.0);
  const double all = std::accumulate(sharp.begin(), sharp.end(), 0.0);
  EXPECT_NEAR(std::accumulate(soft.begin(), soft.end(), 0.0), all, 1e-5 * all);
  double kernel = 0.0;
  for (int i = -8; i <= 8; ++i) kernel += std::exp(-i * i / 8.0);
  const double beyond = 0.5 * (1.0 - 1.0 / kernel);  // of the kernel, on one side of its middle
  // The last black pixel before the line x = 20, in the middle of its square.
  const int x = 79;
  const int y = 59;
  EXPECT_NEAR(overhead_point_mm(view, x, y).x(), 19.5, 1e-9);
  const double fall = 1.0 - 0.15 * 20.0 / 120.0;
  EXPECT_NEAR(soft[static_cast<std::size_t>(y * 240 + x)], fall * (0.045 + 0.955 * beyond), 2e-3);
  EXPECT_NEAR(soft[static_cast<std::size_t>(y * 240 + x + 1)], fall * (1.0 - 0.955 * beyond), 2e-3);
}

}  // namespace
}  // namespace scattermeter::apps
