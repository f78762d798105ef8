#include "apps/simulation/board_picture.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/camera/cfa_pattern.h"
#include "core/mesh/bodies.h"
#include "tests/fixtures/apps/overhead_view.h"

namespace scattermeter::apps {
namespace {

// A board of 100 x 100 mm under the cube of 20 mm, one LED from the right and light from all over.
TEST(BoardPicture, IsTheLightOnThePrint) {
  calib::CharucoBoard board;
  board.squares_x = board.squares_y = 5;
  board.square_mm = 20.0;
  board.marker_mm = 14.0;
  board.world_from_board.translation_mm = {-50, -50, 0};
  Led led;
  led.position_mm = {200, 0, 500};
  led.axis = -led.position_mm.normalized();
  led.exponent = 2.0;
  led.intensity_W_per_sr = {1.0, 2.0, 3.0};
  const Eigen::Array3d ambient(1e-6, 2e-6, 5e-6);
  const CfaPattern cfa = cfa_pattern_from_name("RGGB");
  const CameraView view = overhead_view(0, 0);
  const RayScene cube(cube_mesh());
  std::vector<float> picture(240U * 200U, 1e-9F);
  add_board(view, board, {led}, ambient, cube, cfa, picture);

  const calib::CharucoPattern print(board);
  const auto ink = [&](const Eigen::Vector3d& p) {
    return print.reflectance(p.x() + 50.0, p.y() + 50.0);
  };
  int lit = 0, shadowed = 0, dark = 0;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 240; ++x) {
      const Eigen::Vector3d p = overhead_point_mm(view, x, y);
      const double seen = picture[static_cast<std::size_t>(y * 240 + x)];
      const bool beyond = std::abs(p.x()) > 51 || std::abs(p.y()) > 51;
      // The cube's top, 380 mm below the camera, hides 10.5 mm.
      const bool hidden = std::abs(p.x()) < 9.9 && std::abs(p.y()) < 9.9;
      if (beyond || hidden) {
        EXPECT_EQ(seen, 1e-9F) << p.transpose();
        ++dark;
        continue;
      }
      if (std::abs(p.x()) > 49 || std::abs(p.y()) > 49) continue;
      if (std::abs(p.x()) < 11.6 && std::abs(p.y()) < 11.6) continue;
      // One ink all over the pixel.
      bool even = true;
      for (const double dx : {-0.6, 0.0, 0.6}) {
        for (const double dy : {-0.6, 0.0, 0.6}) {
          even = even && ink(p + Eigen::Vector3d(dx, dy, 0)) == ink(p);
        }
      }
      if (!even) continue;
      // The shadow of the cube's edge at x = -10, z = 20 ends at -10 - 20 * 210 / 480 = -18.75.
      if (p.x() < -9 && p.x() > -20 && std::abs(p.y()) < 11.6 &&
          (p.x() < -17.5 || std::abs(p.y()) > 9.0)) {
        continue;  // at its border
      }
      const bool shadow = p.x() < -9 && p.x() >= -17.5 && std::abs(p.y()) <= 9.0;
      const Eigen::Vector3d to_led = led.position_mm - p;
      const double cos_led = -led.axis.dot(to_led.normalized());
      const double per_intensity =
          cos_led * cos_led * to_led.normalized().z() / to_led.squaredNorm();
      const auto c = static_cast<Eigen::Index>(cfa.at(x, y));
      const double irradiance =
          ambient[c] + (shadow ? 0.0 : led.intensity_W_per_sr[c] * per_intensity);
      const double expected = irradiance / std::numbers::pi * (ink(p) > 0.5 ? 0.9 : 0.04);
      ASSERT_NEAR(seen, expected + 1e-9, 1e-4 * expected) << p.transpose();
      (shadow ? shadowed : lit) += 1;
    }
  }
  EXPECT_GT(lit, 4000);
  EXPECT_GT(shadowed, 30);
  EXPECT_GT(dark, 30000);
}

// Out of view, nothing is added.
TEST(BoardPicture, BehindTheCamera) {
  calib::CharucoBoard board;
  board.squares_x = board.squares_y = 5;
  board.square_mm = 20.0;
  board.marker_mm = 14.0;
  board.world_from_board.translation_mm = {-50, -50, 500};
  std::vector<float> picture(240U * 200U, 0.0F);
  add_board(overhead_view(0, 0), board, {}, {1, 1, 1}, RayScene(cube_mesh()), CfaPattern{},
            picture);
  EXPECT_EQ(picture, std::vector<float>(240U * 200U, 0.0F));
}

}  // namespace
}  // namespace scattermeter::apps
