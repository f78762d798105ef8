#include "core/transport/absorption_tilts.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/dense_solve.h"

namespace scattermeter {

AbsorptionTilts::AbsorptionTilts(double sigma_s_per_mm, double size_mm) {
  if (!(sigma_s_per_mm > 0.0) || !(size_mm > 0.0)) {
    throw std::invalid_argument("AbsorptionTilts: sigma_s = " + std::to_string(sigma_s_per_mm) +
                                " per mm, size " + std::to_string(size_mm) + " mm");
  }
  fading_per_mm_ = std::numbers::pi * std::numbers::pi / (size_mm * size_mm * sigma_s_per_mm);
  const double first = fading_per_mm_ / 8.0;
  constexpr int kLeast = 6;
  std::vector<double> list = {0.0};
  while (list.back() < 2.0 * sigma_s_per_mm || list.size() < kLeast) {
    list.push_back(2.0 * list.back() + first);
  }
  per_mm_ = Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
}

void AbsorptionTilts::add(double weight, double length_mm, double* sums) const {
  const double first = std::exp(-per_mm_[1] * length_mm);
  double factor = 1.0;
  for (Eigen::Index j = 0; j < count(); ++j) {
    sums[j] += weight * factor;
    factor *= factor * first;
  }
}

AbsorptionTilts::Combination AbsorptionTilts::at(double sigma_a_per_mm, Eigen::Index step) const {
  // Least squares over lengths from a fiftieth of a mean free path on, evenly in their logarithm.
  constexpr Eigen::Index kLengths = 400;
  constexpr double kRidge = 1e-14;
  const double shortest = 0.04 / per_mm_[count() - 1];
  const double longest = 40.0 / fading_per_mm_;
  const Eigen::Index n = (count() - 1) / step + 1;
  Eigen::MatrixXd tilts(kLengths, n);
  Eigen::VectorXd light(kLengths), change(kLengths);
  for (Eigen::Index i = 0; i < kLengths; ++i) {
    const double share = static_cast<double>(i - 1) / static_cast<double>(kLengths - 2);
    const double length = i == 0 ? 0.0 : shortest * std::pow(longest / shortest, share);
    const double weight = std::exp(-0.5 * fading_per_mm_ * length);
    for (Eigen::Index j = 0; j < n; ++j) {
      tilts(i, j) = weight * std::exp(-per_mm_[j * step] * length);
    }
    light[i] = weight * std::exp(-sigma_a_per_mm * length);
    change[i] = -length * light[i];
  }
  Eigen::MatrixXd normal = tilts.transpose() * tilts;
  normal.diagonal().array() += kRidge * static_cast<double>(kLengths);
  const SymmetricSolver solver(normal);
  const Eigen::VectorXd of_light = solver.solve(Eigen::VectorXd(tilts.transpose() * light));
  const Eigen::VectorXd of_change = solver.solve(Eigen::VectorXd(tilts.transpose() * change));
  Combination out{Eigen::VectorXd::Zero(count()), Eigen::VectorXd::Zero(count())};
  for (Eigen::Index j = 0; j < n; ++j) {
    out.l[j * step] = of_light[j];
    out.per_sigma_a[j * step] = of_change[j];
  }
  return out;
}

}  // namespace scattermeter
