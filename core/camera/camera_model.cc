#include "core/camera/camera_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <sstream>
#include <stdexcept>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/camera/lens.h"

namespace scattermeter {

std::string intrinsics_problem(const CameraIntrinsics& intrinsics) {
  std::ostringstream out;
  const auto bad_focal = [](double f) { return !std::isfinite(f) || f <= 0; };
  // Decentred lenses and crops shift the principal point, but not farther than this.
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

namespace {

// Undistorted pixels of one row.
class RayRow {
 public:
  RayRow(const Lens& lens, int x0, double y) : lens_(lens), x0_(x0), y_(y) {}

  // Pixels from `column` on, one by one. A parabola through the three neighbours to the left is
  // a start from which one Newton step or none suffices.
  void each(std::span<Eigen::Vector3f> out, int column) const {
    Start start;
    for (Eigen::Vector3f& ray : out) ray = homogeneous(next(column++, start));
  }

  // Cubics through every 16th pixel, wherever they are within the tolerance halfway between these,
  // where the error of a cubic is largest.
  void interpolated(std::span<Eigen::Vector3f> out, double tolerance) const {
    constexpr int kStep = 16;
    using Weights = std::array<double, 4>;
    static const std::array<Weights, kStep> kWeights = [] {
      std::array<Weights, kStep> all;
      for (size_t i = 0; i < all.size(); ++i) {
        const double t = static_cast<double>(i) / kStep;
        all[i] = {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2,
                  -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6};
      }
      return all;
    }();
    Start start;
    std::array<Eigen::Vector2d, 4> knots;  // one before the stretch, its ends, one behind
    for (int k = 0; k < 3; ++k) knots[static_cast<size_t>(k + 1)] = next(kStep * (k - 1), start);
    const auto cubic = [&](const Weights& w) -> Eigen::Vector2d {
      return w[0] * knots[0] + w[1] * knots[1] + w[2] * knots[2] + w[3] * knots[3];
    };
    for (size_t first = 0; first < out.size(); first += kStep) {
      const int column = static_cast<int>(first);
      std::rotate(knots.begin(), knots.begin() + 1, knots.end());
      knots[3] = next(column + 2 * kStep, start);
      const std::span stretch = out.subspan(first, std::min<size_t>(kStep, out.size() - first));
      const Eigen::Vector2d middle = cubic(kWeights[kStep / 2]);
      // Also false for values that are not finite.
      if (middle.allFinite() &&
          (lens_.unproject(pixel(column + kStep / 2), middle) - middle).norm() <= tolerance) {
        for (size_t i = 0; i < stretch.size(); ++i) stretch[i] = homogeneous(cubic(kWeights[i]));
      } else {
        each(stretch, column);
      }
    }
  }

 private:
  // The last three, the nearest first.
  struct Start {
    std::array<Eigen::Vector2d, 3> left;
    Start() { left.fill(Eigen::Vector2d::Constant(std::nan(""))); }
  };

  Eigen::Vector2d pixel(int column) const { return {static_cast<double>(x0_) + column, y_}; }
  static Eigen::Vector3f homogeneous(const Eigen::Vector2d& ray) {
    return {static_cast<float>(ray.x()), static_cast<float>(ray.y()),
            ray.allFinite() ? 1.0F : std::nanf("")};
  }
  Eigen::Vector2d next(int column, Start& start) const {
    const auto& left = start.left;
    const Eigen::Vector2d parabola = 3.0 * (left[0] - left[1]) + left[2];
    const Eigen::Vector2d ray = parabola.allFinite()  ? lens_.unproject(pixel(column), parabola)
                                : left[0].allFinite() ? lens_.unproject(pixel(column), left[0])
                                                      : lens_.unproject(pixel(column));
    start.left = {ray, left[0], left[1]};
    return ray;
  }

  const Lens& lens_;
  int x0_;
  double y_;
};

}  // namespace

std::vector<Eigen::Vector3f> pixel_rays_in_camera(const CameraIntrinsics& intrinsics, int x0,
                                                  int y0, int width, int height) {
  if (width < 0 || height < 0) {
    throw std::invalid_argument("pixel_rays_in_camera: negative size " + std::to_string(width) +
                                " x " + std::to_string(height));
  }
  const Lens lens(intrinsics);
  const bool straight = std::all_of(intrinsics.distortion.begin(), intrinsics.distortion.end(),
                                    [](double term) { return term == 0.0; });
  const double tolerance = 2e-7 / std::max(intrinsics.fx_px, intrinsics.fy_px);
  const auto columns = static_cast<size_t>(width);
  std::vector<Eigen::Vector3f> rays(columns * static_cast<size_t>(height));
  tbb::parallel_for(tbb::blocked_range<int>(0, height, 16), [&](const auto& rows) {
    for (int row = rows.begin(); row != rows.end(); ++row) {
      const std::span out(rays.data() + static_cast<size_t>(row) * columns, columns);
      // Each row starts anew, so that the split among threads does not affect the digits.
      const RayRow ray_row(lens, x0, static_cast<double>(y0) + row);
      straight ? ray_row.each(out, 0) : ray_row.interpolated(out, tolerance);
    }
  });
  return rays;
}

}  // namespace scattermeter
