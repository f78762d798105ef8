#include "core/view/camera_view.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace scattermeter {
namespace {

struct PixelBox {
  double x_min = 1e30, y_min = 1e30, x_max = -1e30, y_max = -1e30;
  bool complete = true;  // false: a vertex has no image
};

// Corners of a convex outline may bow outwards under lens distortion by far less than the margin;
// the bounds of all vertices suffice.
PixelBox image_bounds(const CameraView& view, const TriangleMesh& mesh) {
  PixelBox box;
  for (const Eigen::Vector2d& p :
       project(view.intrinsics, view.camera_from_world, mesh.vertices_mm)) {
    if (!p.allFinite()) {
      box.complete = false;
      continue;
    }
    box.x_min = std::min(box.x_min, p.x());
    box.x_max = std::max(box.x_max, p.x());
    box.y_min = std::min(box.y_min, p.y());
    box.y_max = std::max(box.y_max, p.y());
  }
  return box;
}

}  // namespace

ViewCheck check_view(const CameraView& view, const TriangleMesh& mesh) {
  const PixelBox box = image_bounds(view, mesh);
  ViewCheck out;
  out.in_front = box.complete;
  out.in_frame = box.x_max >= 0.0 && box.y_max >= 0.0 &&
                 box.x_min <= view.intrinsics.width_px - 1.0 &&
                 box.y_min <= view.intrinsics.height_px - 1.0;
  return out;
}

RayGrid rays_around(const CameraView& view, const TriangleMesh& mesh, int margin_px) {
  const PixelBox box = image_bounds(view, mesh);
  const auto low = [&](double v) {
    return std::max(0, static_cast<int>(std::floor(v)) - margin_px) & ~1;
  };
  const auto high = [&](double v, int size) {
    return std::min(size, static_cast<int>(std::ceil(v)) + margin_px + 1);
  };
  RayGrid grid;
  grid.origin_in_world_mm = view.center_in_world_mm();
  grid.x0 = low(box.x_min);
  grid.y0 = low(box.y_min);
  grid.width = high(box.x_max, view.intrinsics.width_px) - grid.x0;
  grid.height = high(box.y_max, view.intrinsics.height_px) - grid.y0;
  grid.directions_in_world =
      pixel_rays_in_camera(view.intrinsics, grid.x0, grid.y0, grid.width, grid.height);
  const Eigen::Matrix3f world_from_camera =
      view.camera_from_world.rotation.conjugate().toRotationMatrix().cast<float>();
  for (Eigen::Vector3f& d : grid.directions_in_world) d = (world_from_camera * d).eval();
  return grid;
}

Rigid3d look_at(const Eigen::Vector3d& position_mm, const Eigen::Vector3d& target_mm,
                const Eigen::Vector3d& up) {
  const Eigen::Vector3d z = (target_mm - position_mm).normalized();  // forward
  const Eigen::Vector3d x = z.cross(up).normalized();                // right
  const Eigen::Vector3d y = z.cross(x);                              // down
  Eigen::Matrix3d camera_from_world;
  camera_from_world << x.transpose(), y.transpose(), z.transpose();
  Rigid3d out;
  out.rotation = Eigen::Quaterniond(camera_from_world).normalized();
  out.translation_mm = -(out.rotation * position_mm);
  return out;
}

}  // namespace scattermeter
