#include "core/view/pixel_points.h"

#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

namespace scattermeter {
namespace {

// Of the lattice (i, kStep i mod n) / n: its shortest vector is 7.6 / 64 long, of 8.6 possible, for
// 64 points, and 3.2 / 16 of 4.3 for 16.
constexpr int kStep = 19;

}  // namespace

PixelPoints::PixelPoints(const RayGrid& rays, int x, int y) {
  const auto direction = [&](int xx, int yy) {
    return rays
        .directions_in_world[static_cast<std::size_t>(yy) * static_cast<std::size_t>(rays.width) +
                             static_cast<std::size_t>(xx)]
        .cast<double>()
        .eval();
  };
  const int xn = x + 1 < rays.width ? x + 1 : x - 1;
  const int yn = y + 1 < rays.height ? y + 1 : y - 1;
  center_ = direction(x, y);
  per_x_ = (direction(xn, y) - center_) * (xn - x);
  per_y_ = (direction(x, yn) - center_) * (yn - y);
}

Eigen::Vector3d PixelPoints::direction(int i, int n) const {
  return direction_at((i + 0.5) / n - 0.5, (kStep * i % n + 0.5) / n - 0.5);
}

double PixelPoints::solid_angle_sr() const {
  const double length = center_.norm();
  return std::abs(per_x_.cross(per_y_).dot(center_)) / (length * length * length);
}

}  // namespace scattermeter
