// A lens prepared for many projections and back-projections, with Jacobians.
#pragma once

#include <Eigen/Core>

#include "core/camera/camera_model.h"
#include "core/camera/distortion.h"

namespace scattermeter {

// Frames and units as in CameraIntrinsics.
class Lens {
 public:
  // Throws std::invalid_argument with the text of intrinsics_problem() unless that is empty.
  explicit Lens(const CameraIntrinsics& intrinsics);

  const Distortion& distortion() const { return distortion_; }

  // Pixel of a point in the camera frame (any unit of length: only its direction counts), and the
  // 2 x 3 Jacobian d(pixel)/d(point) in px per that unit. NaN (both) for depth <= 0 and outside of
  // the distortion's domain.
  Eigen::Vector2d project(const Eigen::Vector3d& x_in_camera,
                          Eigen::Matrix<double, 2, 3>* jacobian = nullptr) const;

  // (X / Z, Y / Z) of the ray through a pixel, such that project() returns to the pixel within
  // 1e-9 px; NaN where the distortion has no inverse. `guess`: a point near the result, which saves
  // steps.
  Eigen::Vector2d unproject(const Eigen::Vector2d& pixel) const;
  Eigen::Vector2d unproject(const Eigen::Vector2d& pixel, const Eigen::Vector2d& guess) const;

 private:
  Eigen::Vector2d distorted(const Eigen::Vector2d& pixel) const {
    return {(pixel.x() - cx_px_) / fx_px_, (pixel.y() - cy_px_) / fy_px_};
  }

  double fx_px_;
  double fy_px_;
  double cx_px_;
  double cy_px_;
  double tolerance_;  // 1e-9 px in the normalised plane
  Distortion distortion_;
};

}  // namespace scattermeter
