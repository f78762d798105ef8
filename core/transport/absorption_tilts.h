// Light at any absorption, from light at a few.
#pragma once

#include <Eigen/Core>

namespace scattermeter {

// The light of paths that absorb nothing, re-weighted to an absorption, is a sum of exp(-sigma_a L)
// over their lengths L. That exponential is nearly a linear combination of a few with fixed
// absorptions ("tilts") a_j = a_1 (2^j - 1): one score adds to all of them with two
// multiplications each. a_1 is an eighth of the rate at which light of a diffusing body of this
// size fades along its path, pi^2 / (size^2 sigma_s), and the largest is at least 2 sigma_s.
// exp(-sigma_a L), weighted by the root of that fading, is met within 1e-3 everywhere for sigma_a
// up to sigma_s; an image is met better, since the errors alternate along L.
class AbsorptionTilts {
 public:
  // Domain: both positive (std::invalid_argument).
  AbsorptionTilts(double sigma_s_per_mm, double size_mm);

  Eigen::Index count() const { return per_mm_.size(); }
  const Eigen::VectorXd& per_mm() const { return per_mm_; }
  // Adds weight * exp(-a_j length) to sums[j].
  void add(double weight, double length_mm, double* sums) const;

  // Coefficients of the tilts. step: only every step-th of them is used (coarser; the others are
  // 0).
  struct Combination {
    Eigen::VectorXd l;            // for exp(-sigma_a L)
    Eigen::VectorXd per_sigma_a;  // for its derivative, times mm
  };
  Combination at(double sigma_a_per_mm, Eigen::Index step = 1) const;

 private:
  double fading_per_mm_;
  Eigen::VectorXd per_mm_;
};

}  // namespace scattermeter
