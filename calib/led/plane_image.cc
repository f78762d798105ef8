#include "calib/led/plane_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scattermeter::calib {
namespace {

std::vector<Eigen::Vector3d> outline(const WhitePlane& plane, int per_side) {
  std::vector<Eigen::Vector3d> points;
  const Eigen::Vector3d x = plane.width_mm * plane.x_axis;
  const Eigen::Vector3d y = plane.height_mm * plane.y_axis;
  for (int k = 0; k < per_side; ++k) {
    const double t = static_cast<double>(k) / per_side;
    for (const Eigen::Vector3d& p :
         {Eigen::Vector3d(t * x), Eigen::Vector3d(x + t * y), Eigen::Vector3d((1.0 - t) * x + y),
          Eigen::Vector3d((1.0 - t) * y)}) {
      points.push_back(plane.origin_mm + p);
    }
  }
  return points;
}

}  // namespace

PlaneImage plane_image(const CameraIntrinsics& intrinsics, const Rigid3d& camera_from_world,
                       const WhitePlane& plane) {
  PlaneImage image;
  const Eigen::Vector3d eye = inverse(camera_from_world).translation_mm;
  if (!(plane.normal().dot(eye - plane.origin_mm) > 0.0)) return image;
  const std::vector<Eigen::Vector3d> points = outline(plane, 8);
  double x_min = 1e30, y_min = 1e30, x_max = -1e30, y_max = -1e30;
  bool any = false;
  for (const Eigen::Vector2d& p : project(intrinsics, camera_from_world, points)) {
    // Parts without an image are outside the frame; the plane is then cut by the edges of the
    // frame.
    if (!p.allFinite()) {
      x_min = y_min = 0.0;
      x_max = intrinsics.width_px;
      y_max = intrinsics.height_px;
      continue;
    }
    any = true;
    x_min = std::min(x_min, p.x());
    x_max = std::max(x_max, p.x());
    y_min = std::min(y_min, p.y());
    y_max = std::max(y_max, p.y());
  }
  if (!any || !(x_max > 0.0) || !(y_max > 0.0) || !(x_min < intrinsics.width_px) ||
      !(y_min < intrinsics.height_px)) {
    return image;
  }
  image.x0 = std::max(0, static_cast<int>(std::floor(x_min))) & ~1;
  image.y0 = std::max(0, static_cast<int>(std::floor(y_min))) & ~1;
  image.width = std::min(intrinsics.width_px, static_cast<int>(std::ceil(x_max)) + 1) - image.x0;
  image.height = std::min(intrinsics.height_px, static_cast<int>(std::ceil(y_max)) + 1) - image.y0;
  for (const Eigen::Vector3d& p : outline(plane, 1)) {
    const double range = (p - eye).norm();
    const double cosine = plane.normal().dot(eye - p) / range;
    image.mm_per_px =
        std::max(image.mm_per_px, range / std::min(intrinsics.fx_px, intrinsics.fy_px) / cosine);
  }
  return image;
}

}  // namespace scattermeter::calib
