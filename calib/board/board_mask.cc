#include "calib/board/board_mask.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

namespace scattermeter::calib {

void mask_paper(const CharucoBoard& board, const RayScene& body, const CameraIntrinsics& intrinsics,
                const Rigid3d& camera_from_world, int border_px, CfaSamples& samples) {
  if (border_px < 0) {
    throw std::invalid_argument("mask_paper: border_px is " + std::to_string(border_px));
  }
  const CharucoPattern pattern(board);
  const Rigid3d world_from_camera = inverse(camera_from_world);
  const Rigid3d board_from_world = inverse(board.world_from_board);
  const Eigen::Vector3d eye_mm = world_from_camera.translation_mm;
  const Eigen::Vector3d eye_in_board = board_from_world * eye_mm;
  if (!(eye_in_board.z() > 0.0)) return;  // seen from behind
  const double margin = 0.5 * board.square_mm;
  const double width = board.squares_x * board.square_mm;
  const double height = board.squares_y * board.square_mm;
  const std::vector<Eigen::Vector3f> rays =
      pixel_rays_in_camera(intrinsics, samples.x0, samples.y0, samples.width, samples.height);
  // The paper as if there were no body, and the samples where the body hides it.
  std::vector<char> paper(rays.size(), 0), hidden(rays.size(), 0);
  tbb::parallel_for(0, samples.height, [&](int row) {
    for (int column = 0; column < samples.width; ++column) {
      const std::size_t i =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(samples.width) +
          static_cast<std::size_t>(column);
      const Eigen::Vector3d ray = world_from_camera.rotation * rays[i].cast<double>();
      const Eigen::Vector3d fall = board_from_world.rotation * ray;
      if (!ray.allFinite() || !(fall.z() < 0.0)) continue;
      const Eigen::Vector3d at = eye_in_board - eye_in_board.z() / fall.z() * fall;
      if (at.x() < -margin || at.y() < -margin || at.x() > width + margin ||
          at.y() > height + margin) {
        continue;
      }
      // Outside the print (NaN) there is blank paper.
      if (pattern.reflectance(at.x(), at.y()) == 0.0) continue;
      paper[i] = 1;
      hidden[i] = body.first_hit(eye_mm, ray).facet_idx >= 0 ? 1 : 0;
    }
  });
  tbb::parallel_for(0, samples.height, [&](int row) {
    for (int column = 0; column < samples.width; ++column) {
      const auto place = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(samples.width) +
               static_cast<std::size_t>(x);
      };
      const std::size_t i = place(column, row);
      bool near = false;
      for (int y = std::max(0, row - border_px);
           !near && y <= std::min(samples.height - 1, row + border_px); ++y) {
        for (int x = std::max(0, column - border_px);
             !near && x <= std::min(samples.width - 1, column + border_px); ++x) {
          near = paper[place(x, y)] != 0 && hidden[place(x, y)] == 0;
        }
      }
      // Samples of the body itself near its edge are not marked, only those beyond the edge.
      if (!near || hidden[i] != 0) continue;
      const Eigen::Vector3d ray = world_from_camera.rotation * rays[i].cast<double>();
      if (paper[i] == 0 && body.first_hit(eye_mm, ray).facet_idx >= 0) continue;
      samples.clipped[i] = std::max(samples.clipped[i], kSampleDefect);
    }
  });
}

}  // namespace scattermeter::calib
