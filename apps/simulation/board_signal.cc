#include "apps/simulation/board_signal.h"

#include <algorithm>
#include <cmath>

#include <oneapi/tbb/parallel_for.h>

namespace scattermeter::apps {
namespace {

constexpr double kBlackPrint = 0.045;
constexpr double kSurround = 0.25;
constexpr double kFall = 0.15;
constexpr int kFine = 8;  // sub-samples per side of a pixel at an edge

// The light that a ray of the camera finds on the board or beside it.
class BoardLight {
 public:
  BoardLight(const CameraView& view, const calib::CalibrationBoard& board)
      : pattern_(board),
        width_mm_(board.squares_x * board.square_mm),
        height_mm_(board.squares_y * board.square_mm),
        margin_mm_(board.square_mm),
        eye_mm_(view.center_in_world_mm()),
        world_from_camera_(view.camera_from_world.rotation.conjugate().toRotationMatrix()) {}

  // ray: (X / Z, Y / Z) in the camera frame.
  double along(const Eigen::Vector2d& ray) const {
    const Eigen::Vector3d d = world_from_camera_ * Eigen::Vector3d(ray.x(), ray.y(), 1);
    const double steps = -eye_mm_.z() / d.z();
    if (!(steps > 0) || !std::isfinite(steps)) return kSurround;
    const double x = eye_mm_.x() + steps * d.x();
    const double y = eye_mm_.y() + steps * d.y();
    const double print = pattern_.reflectance(x, y);
    if (std::isfinite(print)) {
      return (kBlackPrint + (1 - kBlackPrint) * print) * (1 - kFall * x / width_mm_);
    }
    const bool margin = x > -margin_mm_ && x < width_mm_ + margin_mm_ && y > -margin_mm_ &&
                        y < height_mm_ + margin_mm_;
    return margin ? 1 - kFall * std::clamp(x / width_mm_, 0.0, 1.0) : kSurround;
  }

  // Whether two values are those of the same ink.
  static bool alike(double a, double b) { return std::abs(a - b) < 0.02; }

 private:
  calib::BoardPattern pattern_;
  double width_mm_;
  double height_mm_;
  double margin_mm_;
  Eigen::Vector3d eye_mm_;
  Eigen::Matrix3d world_from_camera_;
};

// Blurs along rows or columns; the values at the edge continue beyond it.
std::vector<float> blurred(const std::vector<float>& image, int width, int height, bool along_x,
                           double blur_px) {
  const int reach = static_cast<int>(std::ceil(4 * blur_px));
  std::vector<double> kernel;
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) {
    kernel.push_back(std::exp(-0.5 * i * i / (blur_px * blur_px)));
    sum += kernel.back();
  }
  std::vector<float> out(image.size());
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      double value = 0;
      for (int i = -reach; i <= reach; ++i) {
        const int xx = along_x ? std::clamp(x + i, 0, width - 1) : x;
        const int yy = along_x ? y : std::clamp(y + i, 0, height - 1);
        value += kernel[static_cast<std::size_t>(i + reach)] *
                 static_cast<double>(
                     image[static_cast<std::size_t>(yy) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(xx)]);
      }
      out[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
          static_cast<std::size_t>(x)] = static_cast<float>(value / sum);
    }
  });
  return out;
}

}  // namespace

std::vector<float> board_signal(const CameraView& view, const calib::CalibrationBoard& board,
                                double blur_px) {
  const int width = view.intrinsics.width_px;
  const int height = view.intrinsics.height_px;
  const BoardLight light(view, board);
  // One more row and column: the ray at (x, y) and its neighbours span the pixel.
  const std::vector<Eigen::Vector3f> rays =
      pixel_rays_in_camera(view.intrinsics, 0, 0, width + 1, height + 1);
  const auto ray = [&](int x, int y) -> Eigen::Vector2d {
    return rays[static_cast<std::size_t>(y) * static_cast<std::size_t>(width + 1) +
                static_cast<std::size_t>(x)]
        .head<2>()
        .cast<double>();
  };
  std::vector<float> out(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const auto shade = [&](int x, int y) {
    const Eigen::Vector2d middle = ray(x, y);
    const Eigen::Vector2d per_x = ray(x + 1, y) - middle;
    const Eigen::Vector2d per_y = ray(x, y + 1) - middle;
    if (!middle.allFinite() || !per_x.allFinite() || !per_y.allFinite()) return kSurround;
    const double value = light.along(middle);
    bool uniform = true;
    for (const auto& [fx, fy] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}}) {
      uniform = uniform && BoardLight::alike(value, light.along(middle + fx * per_x + fy * per_y));
    }
    if (uniform) return value;
    double sum = 0;
    for (int i = 0; i < kFine * kFine; ++i) {
      const double fx = (i % kFine + 0.5) / kFine - 0.5;
      const double fy = (static_cast<int>(i / kFine) + 0.5) / kFine - 0.5;
      sum += light.along(middle + fx * per_x + fy * per_y);
    }
    return sum / (kFine * kFine);
  };
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      out[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
          static_cast<std::size_t>(x)] = static_cast<float>(shade(x, y));
    }
  });
  if (!(blur_px > 0)) return out;
  return blurred(blurred(out, width, height, true, blur_px), width, height, false, blur_px);
}

}  // namespace scattermeter::apps
