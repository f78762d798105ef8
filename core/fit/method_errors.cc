#include "core/fit/method_errors.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/material/dipole.h"

namespace scattermeter {

double row_method_error(double patch_size_mm, double mean_free_path_mm) {
  constexpr double kLeast = 3e-5;
  constexpr double kAtOne = 1e-4;
  const double ratio = patch_size_mm / mean_free_path_mm;
  return std::max(kLeast, kAtOne * std::min(ratio * ratio, 16.0));
}

void add_method_errors(const DistanceKnots& knots, const Eigen::VectorXd& r, double patch_size_mm,
                       const Medium& medium, DenseSystem& system) {
  constexpr double kLeastRelativeStd = 1.5e-5;
  constexpr double kAtOne = 1.5e-4;
  const double decay_per_mm =
      std::max(medium.sigma_t_prime_per_mm(), Dipole(medium).sigma_tr_per_mm());
  const double coarse = std::min(patch_size_mm * decay_per_mm, 4.0);
  const Eigen::Index first = system.nuisance_columns.cols();
  const int octaves =
      1 + static_cast<int>(std::log2(knots.max_distance_mm() / knots.resolution_mm()));
  std::vector<Eigen::Index> shot_rows = system.shot_rows;
  if (shot_rows.empty()) shot_rows = {system.l.size()};
  const Eigen::Index added = octaves + static_cast<Eigen::Index>(shot_rows.size());
  system.nuisance_columns.conservativeResize(system.l.size(), first + added);
  system.nuisance_columns.rightCols(added).setZero();
  for (int o = 0; o < octaves; ++o) {
    const double from_mm = o == 0 ? -1.0 : std::ldexp(knots.resolution_mm(), o);
    const double to_mm = std::ldexp(knots.resolution_mm(), o + 1);
    const auto& d = knots.knots_mm();
    const auto begin = std::lower_bound(d.begin(), d.end(), from_mm) - d.begin();
    const auto n = std::lower_bound(d.begin(), d.end(), to_mm) - d.begin() - begin;
    system.nuisance_columns.col(first + o).noalias() =
        system.weights.middleCols(begin, n) * r.segment(begin, n);
  }
  const Eigen::VectorXd predicted = system.weights * r;
  Eigen::Index row = 0;
  for (std::size_t s = 0; s < shot_rows.size(); ++s) {
    const Eigen::Index n = shot_rows[s];
    system.nuisance_columns.col(first + octaves + static_cast<Eigen::Index>(s)).segment(row, n) =
        predicted.segment(row, n);
    row += n;
  }
  system.nuisances.insert(
      system.nuisances.end(), static_cast<std::size_t>(added),
      {"numerics", std::max(kLeastRelativeStd, kAtOne * coarse * coarse), false});
}

}  // namespace scattermeter
