#include "calib/pose/picture_blur.h"

#include <algorithm>
#include <cmath>

#include "core/base/dense_solve.h"
#include "core/base/median.h"

namespace scattermeter::calib {

double picture_blur_px(const std::vector<EdgeBlur>& edges) {
  constexpr Eigen::Index kTerms = 3;
  constexpr double kByChance = 12.0;
  std::vector<double> blurs;
  for (const EdgeBlur& e : edges) blurs.push_back(e.blur_px);
  const double median_px = upper_median(blurs);
  const auto n = static_cast<Eigen::Index>(edges.size());
  if (n <= 2 * kTerms) return median_px;
  Eigen::MatrixXd terms(n, kTerms);
  Eigen::VectorXd square(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const EdgeBlur& e = edges[static_cast<std::size_t>(i)];
    const double t = 2.0 * std::atan2(e.outward.y(), e.outward.x());
    terms.row(i) << 1.0, std::cos(t), std::sin(t);
    square[i] = e.blur_px * e.blur_px;
  }
  const Eigen::Vector3d fit = PivotedSolver(terms).solve(square);
  const double left = (square - terms * fit).squaredNorm() / static_cast<double>(n - kTerms);
  const double explained = (square.array() - square.mean()).matrix().squaredNorm() -
                           left * static_cast<double>(n - kTerms);
  if (!(explained > 2.0 * kByChance * left)) return median_px;
  // Edges in few directions do not tell what is between them.
  const double along_px = std::min(std::sqrt(std::max(0.0, fit[0] + std::hypot(fit[1], fit[2]))),
                                   *std::max_element(blurs.begin(), blurs.end()));
  return std::max(median_px, along_px);
}

}  // namespace scattermeter::calib
