#include "core/view/row_blur.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "core/base/tangents.h"

namespace scattermeter {
namespace {

// The covariance on the surface, in its tangents, of displacements in the picture.
Eigen::Matrix2d covariance_on_surface(const Eigen::Matrix<double, 3, 2>& tangents,
                                      const Eigen::Vector3d& normal,
                                      const Eigen::Vector3d& to_camera,
                                      const Eigen::Matrix<double, 3, 2>& picture_axes,
                                      const Eigen::Matrix2d& covariance) {
  constexpr double kLeastCosine = 0.1;
  const double cosine = std::max(kLeastCosine, normal.dot(to_camera));
  const Eigen::Matrix<double, 3, 2> across =
      picture_axes - to_camera * (to_camera.transpose() * picture_axes);
  const Eigen::Matrix<double, 3, 2> on_surface =
      across - to_camera * (normal.transpose() * across) / cosine;
  const Eigen::Matrix2d in_tangents = tangents.transpose() * on_surface;
  return in_tangents * covariance * in_tangents.transpose();
}

// Of each sample to the nearest one of no row, or to the map's border: in steps of a king on a
// chessboard, so at most the distance in px.
std::vector<int> steps_to_edge(const SampleMap& map) {
  std::vector<int> steps(map.row_of_sample.size(), 0);
  const auto at = [&](int x, int y) {
    const bool inside = x >= 0 && y >= 0 && x < map.width && y < map.height;
    return inside ? steps[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                          static_cast<std::size_t>(x)]
                  : 0;
  };
  // Forwards, from the neighbours that were visited; then backwards.
  for (const int sign : {1, -1}) {
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const std::size_t i = sign > 0 ? k : steps.size() - 1 - k;
      if (map.row_of_sample[i] < 0) continue;
      const int x = static_cast<int>(i % static_cast<std::size_t>(map.width));
      const int y = static_cast<int>(i / static_cast<std::size_t>(map.width));
      const int nearest = 1 + std::min({at(x - sign, y), at(x - 1, y - sign), at(x, y - sign),
                                        at(x + 1, y - sign)});
      steps[i] = sign > 0 ? nearest : std::min(steps[i], nearest);
    }
  }
  return steps;
}

}  // namespace

Eigen::VectorXd change_by_blur(const BlurredRows& rows, const Eigen::Matrix3Xd& gradient_per_mm,
                               const Eigen::Matrix2d& covariance_mm2) {
  const std::size_t n = rows.centers_mm.size();
  if (rows.normals.size() != n || rows.adjacent.size() != n ||
      gradient_per_mm.cols() != static_cast<Eigen::Index>(n)) {
    throw std::invalid_argument("change_by_blur: sizes differ");
  }
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n));
  for (std::size_t j = 0; j < n; ++j) {
    const auto axes = tangents(rows.normals[j]);
    Eigen::Matrix<double, 3, 2> along;
    along << axes[0], axes[1];
    // Least squares for the second derivatives a, b, c of [a b; b c].
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    Eigen::Vector3d products = Eigen::Vector3d::Zero();
    for (const std::int32_t neighbour : rows.adjacent[j]) {
      const auto i = static_cast<std::size_t>(neighbour);
      const Eigen::Vector2d by_mm = along.transpose() * (rows.centers_mm[i] - rows.centers_mm[j]);
      const Eigen::Vector2d change =
          along.transpose() *
          (gradient_per_mm.col(neighbour) - gradient_per_mm.col(static_cast<Eigen::Index>(j)));
      const Eigen::Matrix<double, 2, 3> of_second{{by_mm.x(), by_mm.y(), 0.0},
                                                  {0.0, by_mm.x(), by_mm.y()}};
      squares += of_second.transpose() * of_second;
      products += of_second.transpose() * change;
    }
    // What a line of neighbours does not tell is taken as zero.
    constexpr double kOfTrace = 1e-6;
    if (!(squares.trace() > 0.0)) continue;
    squares.diagonal().array() += kOfTrace * squares.trace();
    const Eigen::Vector3d second = squares.ldlt().solve(products);
    const Eigen::Matrix2d of_light{{second[0], second[1]}, {second[1], second[2]}};
    const Eigen::Vector3d to_camera = (rows.camera_center_mm - rows.centers_mm[j]).normalized();
    out[static_cast<Eigen::Index>(j)] =
        0.5 * (of_light * covariance_on_surface(along, rows.normals[j], to_camera,
                                                rows.picture_axes, covariance_mm2))
                  .trace();
  }
  return out;
}

std::vector<double> leaked_by_blur(const SampleMap& map, const std::vector<double>& light,
                                   double blur_px) {
  constexpr double kReach = 4.0;  // standard deviations
  constexpr int kGuard_px = SampleMapOptions{}.guard_px;
  std::vector<double> out(light.size(), 0.0);
  const int reach_px = static_cast<int>(std::ceil(kReach * blur_px)) - kGuard_px;
  if (reach_px <= 0) return out;
  const std::vector<int> steps = steps_to_edge(map);
  std::vector<std::size_t> n(light.size(), 0);
  const int window_px = reach_px + 2 * kGuard_px;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                     static_cast<std::size_t>(x);
      if (map.row_of_sample[i] < 0) continue;
      const auto row = static_cast<std::size_t>(map.row_of_sample[i]);
      ++n[row];
      if (steps[i] > reach_px) continue;
      double brightest = light[row];
      for (int v = std::max(0, y - window_px); v < std::min(map.height, y + window_px + 1); ++v) {
        for (int u = std::max(0, x - window_px); u < std::min(map.width, x + window_px + 1); ++u) {
          const std::int32_t other =
              map.row_of_sample[static_cast<std::size_t>(v) * static_cast<std::size_t>(map.width) +
                                static_cast<std::size_t>(u)];
          if (other >= 0) brightest = std::max(brightest, light[static_cast<std::size_t>(other)]);
        }
      }
      const double beyond = 0.5 * std::erfc((steps[i] - 0.5 + kGuard_px) / (M_SQRT2 * blur_px));
      out[row] += light[row] > 0.0 ? beyond * brightest / light[row] : 0.0;
    }
  }
  for (std::size_t row = 0; row < out.size(); ++row) {
    if (n[row] > 0) out[row] /= static_cast<double>(n[row]);
  }
  return out;
}

}  // namespace scattermeter
