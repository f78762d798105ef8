#include "core/fit/dipole_starts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/diffusion/dipole_curve.h"

namespace scattermeter {

std::vector<DipoleSolver::Point> dipole_starts(const Eigen::MatrixXd& kernel,
                                               const Eigen::VectorXd& whitened,
                                               const DistanceKnots& knots, double eta_int_over_ext,
                                               const ScalePrior& scale) {
  using Start = DipoleSolver::Point;
  std::vector<Start> line;
  const int steps =
      1 + static_cast<int>(2.0 * std::log2(knots.max_distance_mm() / knots.resolution_mm()));
  for (int k = 0; k < steps; ++k) {
    Start best;
    best.u = -std::log(knots.resolution_mm()) - 0.5 * k * std::numbers::ln2;
    best.cost = std::numeric_limits<double>::infinity();
    for (double q : {1e-5, 1e-3, 0.01, 0.05, 0.15, 0.3, 0.5, 0.75}) {
      const Eigen::VectorXd p = kernel * dipole_curve(knots, best.u, q, eta_int_over_ext).r;
      const auto offer = [&](double log_s) {
        // A scale without a prior costs nothing; an exact one is 0 here.
        const double pull = log_s == 0.0 ? 0.0 : log_s / scale.relative_std;
        const double cost = (std::exp(log_s) * p - whitened).squaredNorm() + pull * pull;
        if (!(cost < best.cost)) return;
        best.cost = cost;
        best.q = q;
        best.log_s = log_s;
      };
      if (!scale.is_free()) offer(0.0);
      if (!(scale.relative_std > 0.0)) continue;
      // Linear in s, weighted by its prior.
      const double prior = 1.0 / (scale.relative_std * scale.relative_std);
      const double s = (p.dot(whitened) + prior) / (p.squaredNorm() + prior);
      if (s > 0.0) offer(std::log(s));
    }
    line.push_back(best);
  }
  std::vector<Start> minima;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (!std::isfinite(line[k].cost)) continue;
    const bool below_last = k == 0 || line[k].cost < line[k - 1].cost;
    const bool below_next = k + 1 == line.size() || line[k].cost <= line[k + 1].cost;
    if (below_last && below_next) minima.push_back(line[k]);
  }
  if (minima.empty()) minima.push_back(line.front());
  // The best start nearly always leads to the optimum; more than three would only cost time.
  std::sort(minima.begin(), minima.end(),
            [](const Start& a, const Start& b) { return a.cost < b.cost; });
  minima.resize(std::min<std::size_t>(minima.size(), 3));
  return minima;
}

}  // namespace scattermeter
