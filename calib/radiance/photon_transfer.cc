#include "calib/radiance/photon_transfer.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "core/base/dense_solve.h"

namespace scattermeter::calib {

PhotonTransfer fit_photon_transfer(const std::vector<NoisePoint>& points) {
  PhotonTransfer out;
  std::vector<NoisePoint> used;
  for (const NoisePoint& p : points) {
    if (p.degrees_of_freedom >= 2.0) used.push_back(p);
  }
  if (used.size() < 3) return out;
  Eigen::Vector2d line(0.0, 0.0);  // read variance, 1 / gain
  Eigen::Matrix2d normal;
  constexpr int kTurns = 8;
  for (int turn = 0; turn < kTurns; ++turn) {
    normal.setZero();
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    for (const NoisePoint& p : used) {
      const Eigen::Vector2d row(1.0, p.counts);
      // In the first iteration all points have the same weight.
      const double predicted = turn == 0 ? 1.0 + std::max(0.0, p.counts)
                                         : std::max(line.dot(row), 1e-6) + p.quantisation_counts2;
      const double weight = p.degrees_of_freedom / (2.0 * predicted * predicted);
      normal += weight * row * row.transpose();
      moment += weight * row * (p.variance_counts2 - p.quantisation_counts2);
    }
    line = SymmetricSolver(normal).solve(moment);
  }
  const Eigen::Matrix2d covariance = normal.inverse();
  double chi2 = 0;
  for (const NoisePoint& p : used) {
    const double predicted = std::max(line[0] + line[1] * p.counts, 1e-6) + p.quantisation_counts2;
    const double sigmas =
        (p.variance_counts2 - predicted) / (predicted * std::sqrt(2.0 / p.degrees_of_freedom));
    chi2 += sigmas * sigmas;
    out.worst_sigma = std::max(out.worst_sigma, std::abs(sigmas));
  }
  out.reduced_chi2 = chi2 / static_cast<double>(used.size() - 2);
  // By chance alone it reaches 1 + 3 sqrt(2 / n).
  const double chance = 1.0 + 3.0 * std::sqrt(2.0 / static_cast<double>(used.size() - 2));
  const double widen = out.reduced_chi2 > chance ? std::sqrt(out.reduced_chi2) : 1.0;
  const double slope_std = std::sqrt(covariance(1, 1)) * widen;
  if (!line.allFinite() || !(line[1] > 3.0 * slope_std)) return out;
  out.gain_e_per_count = 1.0 / line[1];
  out.gain_std = slope_std / (line[1] * line[1]);
  out.read_noise_counts = std::sqrt(std::max(0.0, line[0]));
  const double read_variance_std = std::sqrt(covariance(0, 0)) * widen;
  out.read_noise_std =
      read_variance_std / std::max(2.0 * out.read_noise_counts, std::sqrt(read_variance_std));
  out.ok = true;
  return out;
}

}  // namespace scattermeter::calib
