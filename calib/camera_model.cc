#include "calib/camera_model.h"

#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "calib/lens.h"

namespace scattermeter::calib {

std::string intrinsics_problem(const CameraIntrinsics& intrinsics) {
  std::ostringstream out;
  const auto bad_focal = [](double f) { return !std::isfinite(f) || f <= 0; };
  // Decentred lenses and crops move the principal point, but not farther than that.
  const auto bad_center = [](double c, int size) { return !(c >= -0.5 * size && c <= 1.5 * size); };
  if (intrinsics.width_px <= 0 || intrinsics.height_px <= 0) {
    out << "image size must be positive, got " << intrinsics.width_px << " x "
        << intrinsics.height_px << " px";
  } else if (bad_focal(intrinsics.fx_px)) {
    out << "fx_px must be positive and finite, got " << intrinsics.fx_px;
  } else if (bad_focal(intrinsics.fy_px)) {
    out << "fy_px must be positive and finite, got " << intrinsics.fy_px;
  } else if (bad_center(intrinsics.cx_px, intrinsics.width_px)) {
    out << "cx_px must lie within half a frame of the frame (width " << intrinsics.width_px
        << " px), got " << intrinsics.cx_px;
  } else if (bad_center(intrinsics.cy_px, intrinsics.height_px)) {
    out << "cy_px must lie within half a frame of the frame (height " << intrinsics.height_px
        << " px), got " << intrinsics.cy_px;
  } else if (const size_t n = intrinsics.distortion.size(); n != 0 && n != 4 && n != 5 && n != 8) {
    out << "distortion must have 0, 4, 5 or 8 terms (k1 k2 p1 p2 [k3 [k4 k5 k6]]), got " << n;
  } else {
    for (size_t i = 0; i < n; ++i) {
      if (!std::isfinite(intrinsics.distortion[i])) {
        out << "distortion term " << i + 1 << " must be finite, got " << intrinsics.distortion[i];
        break;
      }
    }
  }
  return out.str();
}

std::vector<Eigen::Vector2d> project(const CameraIntrinsics& intrinsics,
                                     const Rigid3d& camera_from_world,
                                     const std::vector<Eigen::Vector3d>& points_in_world_mm) {
  const Lens lens(intrinsics);
  std::vector<Eigen::Vector2d> pixels;
  pixels.reserve(points_in_world_mm.size());
  for (const Eigen::Vector3d& x_in_world_mm : points_in_world_mm) {
    pixels.push_back(lens.project(camera_from_world * x_in_world_mm));
  }
  return pixels;
}

std::vector<Eigen::Vector2d> undistort(const CameraIntrinsics& intrinsics,
                                       const std::vector<Eigen::Vector2d>& points_in_image_px) {
  const Lens lens(intrinsics);
  std::vector<Eigen::Vector2d> rays;
  rays.reserve(points_in_image_px.size());
  for (const Eigen::Vector2d& pixel : points_in_image_px) rays.push_back(lens.unproject(pixel));
  return rays;
}

std::vector<Eigen::Vector3f> pixel_rays_in_camera(const CameraIntrinsics& intrinsics, int x0,
                                                  int y0, int width, int height) {
  if (width < 0 || height < 0) {
    throw std::invalid_argument("pixel_rays_in_camera: negative size " + std::to_string(width) +
                                " x " + std::to_string(height));
  }
  const Lens lens(intrinsics);
  const auto columns = static_cast<size_t>(width);
  std::vector<Eigen::Vector3f> rays(columns * static_cast<size_t>(height));
  tbb::parallel_for(tbb::blocked_range<int>(0, height, 16), [&](const auto& rows) {
    for (int row = rows.begin(); row != rows.end(); ++row) {
      Eigen::Vector3f* out = rays.data() + static_cast<size_t>(row) * columns;
      // Without distortion unproject() is exact. With it, a parabola through the three neighbours
      // to the left is a start from which one Newton step or none suffices; each row begins afresh,
      // so that the split among threads does not show in the digits.
      const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::nan(""));
      std::array<Eigen::Vector2d, 3> left = {none, none, none};  // the nearest first
      for (int column = 0; column < width; ++column) {
        const Eigen::Vector2d pixel(static_cast<double>(x0) + column,
                                    static_cast<double>(y0) + row);
        const Eigen::Vector2d parabola = 3.0 * (left[0] - left[1]) + left[2];
        const Eigen::Vector2d ray = parabola.allFinite()  ? lens.unproject(pixel, parabola)
                                    : left[0].allFinite() ? lens.unproject(pixel, left[0])
                                                          : lens.unproject(pixel);
        left = {ray, left[0], left[1]};
        out[column] = Eigen::Vector3f(static_cast<float>(ray.x()), static_cast<float>(ray.y()),
                                      ray.allFinite() ? 1.0F : std::nanf(""));
      }
    }
  });
  return rays;
}

}  // namespace scattermeter::calib
