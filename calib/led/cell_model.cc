#include "calib/led/cell_model.h"

#include <numbers>

#include <Eigen/Cholesky>

#include "core/camera/pose_shift.h"

namespace scattermeter::calib {

CellModel::CellModel(const LedFrame& frame, const ShadedCell& cell)
    : frame_(frame), channel_(cell.channel) {
  const WhitePlane& plane = frame.scene.planes[cell.plane];
  normal_ = plane.normal();
  albedo_over_pi_ = plane.albedo[cell.channel] / std::numbers::pi;
  albedo_std_ = plane.albedo_relative_std;
  const std::vector<double>& exposures = frame.scene.exposure_relative_std;
  exposure_std_ = exposures.empty() ? 0.0 : exposures.at(cell.setting);
  const Eigen::Matrix2d root = cell.spread_mm2.llt().matrixL();
  for (std::size_t k = 0; k < kPoints; ++k) {
    const Eigen::Vector2d at =
        cell.on_plane_mm + (k % 2 == 0 ? M_SQRT2 : -M_SQRT2) * root.col(static_cast<int>(k / 2));
    points_mm_[k] = plane.origin_mm + at.x() * plane.x_axis + at.y() * plane.y_axis;
  }
  shift_ = surface_shift_by_pose(frame.scene.views[cell.view].camera_from_world,
                                 frame.scene.cell_mm(cell), normal_) *
           frame.pose_root[cell.view];
  if (frame.led.radius_mm > 0.0) {
    for (std::size_t k = 0; k < kPoints; ++k) {
      ring_mm_.push_back(frame.led.radius_mm * M_SQRT1_2 * (k % 2 == 0 ? 1.0 : -1.0) *
                         frame.tangents[k / 2]);
    }
  } else {
    ring_mm_.emplace_back(Eigen::Vector3d::Zero());
  }
}

double cell_radiance(const LedScene& scene, const ShadedCell& cell, const Led& led) {
  const LedFrame frame(scene, led);
  const std::array<double, kLedParameters> x = frame.start();
  const std::array<double, 6> pose{};
  const double albedo = 0.0;
  const double exposure = 0.0;
  return CellModel(frame, cell).radiance(x.data(), pose.data(), &albedo, &exposure);
}

}  // namespace scattermeter::calib
