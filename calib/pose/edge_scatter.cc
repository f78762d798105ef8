#include "calib/pose/edge_scatter.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/dense_solve.h"

namespace scattermeter::calib {
namespace {

using Lines = std::map<std::pair<int, int>, std::vector<std::size_t>>;

Lines lines_of(const std::vector<EdgePoint>& points) {
  Lines lines;
  for (std::size_t i = 0; i < points.size(); ++i) {
    lines[{points[i].body_idx, points[i].line_idx}].push_back(i);
  }
  return lines;
}

constexpr double kLargest = 30.0;  // px

// The additional standard deviation of each piece with which the sum of squares about a straight
// line fitted to each edge (in each shot) has its expectation, and the sum that results.
double piece_scatter_px(const std::vector<EdgePoint>& points, const std::vector<double>& residual,
                        double* squares, double* freedom) {
  const Lines lines = lines_of(points);
  *freedom = 0;
  const auto sum = [&](double s) {
    double total = 0;
    *freedom = 0;
    for (const auto& [key, which] : lines) {
      const auto n = static_cast<Eigen::Index>(which.size());
      Eigen::MatrixXd a(n, 2);
      Eigen::VectorXd b(n);
      for (Eigen::Index i = 0; i < n; ++i) {
        const EdgePoint& p = points[which[static_cast<std::size_t>(i)]];
        const double w = 1 / std::hypot(p.std_px, s);
        const Eigen::Vector2d along(-p.outward.y(), p.outward.x());
        a.row(i) << w, w * along.dot(p.measured_px - points[which[0]].measured_px) * 0.01;
        b[i] = w * residual[which[static_cast<std::size_t>(i)]];
      }
      const PivotedSolver qr(a);
      total += (b - a * qr.solve(b)).squaredNorm();
      *freedom += static_cast<double>(n - qr.rank());
    }
    return total;
  };
  double low = 0;
  double high = kLargest;
  *squares = sum(0);
  if (*squares <= *freedom) return 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (sum(middle) > *freedom ? low : high) = middle;
  }
  *squares = sum(high);
  return high;
}

}  // namespace

EdgeScatter edge_scatter(const std::vector<EdgePoint>& points, const CameraIntrinsics& intrinsics,
                         const Rigid3d& camera_from_world, const EdgeFitOptions& model,
                         double floor_px) {
  EdgeScatter out;
  EdgeFitOptions fit = model;
  fit.robust = false;
  fit.line_std_px = floor_px;
  fit.piece_std_px = 0;
  // Residuals of a fit, so that the lines are straight.
  const EdgeFit first = fit_edges(points, intrinsics, camera_from_world, fit);
  double squares = 0;
  double freedom = 0;
  out.piece_std_px = piece_scatter_px(points, first.residual_px, &squares, &freedom);
  fit.piece_std_px = out.piece_std_px;
  const double expected =
      squares + std::max(1.0, 2.0 * static_cast<double>(lines_of(points).size()) -
                                  static_cast<double>(fit.free.size()));
  const auto chi2 = [&](double line_std_px) {
    fit.line_std_px = line_std_px;
    return fit_edges(points, intrinsics, camera_from_world, fit).chi2;
  };
  out.line_std_px = floor_px;
  if (chi2(floor_px) <= expected) return out;
  double low = floor_px;
  double high = std::max(0.01, 2 * floor_px);
  while (high < kLargest && chi2(high) > expected) {
    low = high;
    high *= 2;
  }
  for (int i = 0; i < 10; ++i) {
    const double middle = 0.5 * (low + high);
    (chi2(middle) > expected ? low : high) = middle;
  }
  out.line_std_px = high;
  return out;
}

}  // namespace scattermeter::calib
