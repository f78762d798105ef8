#include "calib/radiance/white_pixels.h"

namespace scattermeter::calib {

std::vector<WhitePixel> white_pixels(const WhitePlane& plane, const CameraView& view,
                                     double margin_mm) {
  const CameraIntrinsics& k = view.intrinsics;
  const std::vector<Eigen::Vector3f> rays = pixel_rays_in_camera(k, 0, 0, k.width_px, k.height_px);
  const Eigen::Vector3d eye_mm = view.center_in_world_mm();
  const Eigen::Quaterniond world_from_camera = view.camera_from_world.rotation.conjugate();
  std::vector<WhitePixel> out;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto at = plane.meet_mm(eye_mm, world_from_camera * rays[i].cast<double>());
    if (!at || at->x() < margin_mm || at->y() < margin_mm || at->x() > plane.width_mm - margin_mm ||
        at->y() > plane.height_mm - margin_mm) {
      continue;
    }
    out.push_back({i, plane.origin_mm + at->x() * plane.x_axis + at->y() * plane.y_axis});
  }
  return out;
}

}  // namespace scattermeter::calib
