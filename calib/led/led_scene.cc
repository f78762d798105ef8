#include "calib/led/led_scene.h"

#include <algorithm>

namespace scattermeter::calib {

std::size_t LedScene::plane_shots() const {
  std::size_t n = 0;
  for (const ShadedCell& cell : cells) n = std::max(n, cell.shot + 1);
  return n;
}

Eigen::Vector3d LedScene::cell_mm(const ShadedCell& cell) const {
  const WhitePlane& plane = planes[cell.plane];
  return plane.origin_mm + cell.on_plane_mm.x() * plane.x_axis +
         cell.on_plane_mm.y() * plane.y_axis;
}

Eigen::Vector3d LedScene::data_center_mm(const std::vector<bool>& use_cell,
                                         const std::vector<bool>& use_highlight) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double n = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!use_cell[i]) continue;
    sum += cell_mm(cells[i]);
    n += 1.0;
  }
  if (n == 0.0) {
    for (std::size_t i = 0; i < highlights.size(); ++i) {
      if (!use_highlight[i]) continue;
      sum += spheres[highlights[i].sphere].center_mm;
      n += 1.0;
    }
  }
  return sum / n;
}

}  // namespace scattermeter::calib
