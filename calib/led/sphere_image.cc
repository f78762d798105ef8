#include "calib/led/sphere_image.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/camera/lens.h"

namespace scattermeter::calib {

SphereImage sphere_image(const CameraIntrinsics& intrinsics, const Rigid3d& camera_from_world,
                         const MirrorSphere& sphere) {
  constexpr int kSides = 48;
  constexpr int kMargin = 4;
  SphereImage image;
  const Lens lens(intrinsics);
  const Eigen::Vector3d c = camera_from_world * sphere.center_mm;
  const double distance = c.norm();
  if (!(distance > sphere.radius_mm) || !(c.z() > 0.0)) return image;
  // The outline is the circle of points where rays are tangent to the sphere.
  const Eigen::Vector3d axis = c / distance;
  const double sine = sphere.radius_mm / distance;
  const Eigen::Vector3d foot = c - sphere.radius_mm * sine * axis;
  const double ring_mm = sphere.radius_mm * std::sqrt(1.0 - sine * sine);
  const Eigen::Vector3d u = axis.unitOrthogonal();
  const Eigen::Vector3d v = axis.cross(u);
  image.center_px = lens.project(c);
  if (!image.center_px.allFinite()) return image;
  double x_min = 1e30, y_min = 1e30, x_max = -1e30, y_max = -1e30;
  image.radius_px = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kSides; ++k) {
    const double t = 2.0 * M_PI * k / kSides;
    const Eigen::Vector2d p = lens.project(foot + ring_mm * (std::cos(t) * u + std::sin(t) * v));
    if (!p.allFinite()) return image;
    x_min = std::min(x_min, p.x());
    x_max = std::max(x_max, p.x());
    y_min = std::min(y_min, p.y());
    y_max = std::max(y_max, p.y());
    image.radius_px = std::min(image.radius_px, (p - image.center_px).norm());
  }
  if (!(x_max > 0.0) || !(y_max > 0.0) || !(x_min < intrinsics.width_px) ||
      !(y_min < intrinsics.height_px)) {
    return image;
  }
  image.x0 = std::max(0, static_cast<int>(std::floor(x_min)) - kMargin) & ~1;
  image.y0 = std::max(0, static_cast<int>(std::floor(y_min)) - kMargin) & ~1;
  image.width =
      (std::min(intrinsics.width_px, static_cast<int>(std::ceil(x_max)) + kMargin) - image.x0) & ~1;
  image.height =
      (std::min(intrinsics.height_px, static_cast<int>(std::ceil(y_max)) + kMargin) - image.y0) &
      ~1;
  if (image.width < 4 || image.height < 4) image.width = image.height = 0;
  return image;
}

}  // namespace scattermeter::calib
