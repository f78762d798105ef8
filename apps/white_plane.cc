#include "apps/white_plane.h"

namespace scattermeter::apps {

Eigen::Vector3d white_normal(const RigWhite& white) { return white.x_axis.cross(white.y_axis); }

std::vector<WhitePixel> white_pixels(const RigWhite& white, const CameraView& view,
                                     double margin_mm) {
  const calib::CameraIntrinsics& k = view.intrinsics;
  const std::vector<Eigen::Vector3f> rays =
      calib::pixel_rays_in_camera(k, 0, 0, k.width_px, k.height_px);
  const Eigen::Vector3d center = view.center_in_world_mm();
  const Eigen::Quaterniond world_from_camera = view.camera_from_world.rotation.conjugate();
  const Eigen::Vector3d normal = white_normal(white);
  const double height_mm = normal.dot(white.origin_mm - center);
  std::vector<WhitePixel> out;
  if (!(height_mm < 0.0)) return out;  // seen from behind
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d ray = world_from_camera * rays[i].cast<double>();
    const double along = height_mm / normal.dot(ray);
    if (!(along > 0.0)) continue;
    const Eigen::Vector3d point = center + along * ray;
    const double x = white.x_axis.dot(point - white.origin_mm);
    const double y = white.y_axis.dot(point - white.origin_mm);
    if (x >= margin_mm && y >= margin_mm && x <= white.size_mm[0] - margin_mm &&
        y <= white.size_mm[1] - margin_mm) {
      out.push_back({i, point});
    }
  }
  return out;
}

}  // namespace scattermeter::apps
