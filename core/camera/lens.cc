#include "core/camera/lens.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace scattermeter {
namespace {

constexpr double kNoImage = std::numeric_limits<double>::quiet_NaN();

const CameraIntrinsics& checked(const CameraIntrinsics& intrinsics) {
  const std::string problem = intrinsics_problem(intrinsics);
  if (!problem.empty()) throw std::invalid_argument("intrinsics: " + problem);
  return intrinsics;
}

}  // namespace

Lens::Lens(const CameraIntrinsics& intrinsics)
    : fx_px_(checked(intrinsics).fx_px),
      fy_px_(intrinsics.fy_px),
      cx_px_(intrinsics.cx_px),
      cy_px_(intrinsics.cy_px),
      // Never below what a double resolves at the corner of a wide frame.
      tolerance_(std::max(1e-9 / std::max(fx_px_, fy_px_), 1e-15)),
      distortion_(intrinsics.distortion) {}

Eigen::Vector2d Lens::project(const Eigen::Vector3d& x_in_camera,
                              Eigen::Matrix<double, 2, 3>* jacobian) const {
  const double depth = x_in_camera.z();
  if (!(depth > 0)) {
    if (jacobian != nullptr) jacobian->setConstant(kNoImage);
    return {kNoImage, kNoImage};
  }
  const Eigen::Vector2d x = x_in_camera.head<2>() / depth;
  Eigen::Matrix2d bend;
  const Eigen::Vector2d bent = distortion_.apply(x, jacobian != nullptr ? &bend : nullptr);
  if (jacobian != nullptr) {
    // d(X/Z, Y/Z)/d(X, Y, Z) = [I | -x] / Z.
    jacobian->leftCols<2>() = bend / depth;
    jacobian->col(2) = -bend * x / depth;
    jacobian->row(0) *= fx_px_;
    jacobian->row(1) *= fy_px_;
  }
  return {fx_px_ * bent.x() + cx_px_, fy_px_ * bent.y() + cy_px_};
}

Eigen::Vector2d Lens::unproject(const Eigen::Vector2d& pixel) const {
  return unproject(pixel, distorted(pixel));
}

Eigen::Vector2d Lens::unproject(const Eigen::Vector2d& pixel, const Eigen::Vector2d& guess) const {
  return distortion_.invert(distorted(pixel), guess, tolerance_);
}

}  // namespace scattermeter
