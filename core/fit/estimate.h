// The result of every estimator.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace scattermeter {

struct Quantity {
  double value = 0;
  double std = 0;
  double low95 = 0;  // 95 % interval
  double high95 = 0;
};

// A quantity that cannot be negative, with a normal error: the interval is value +- 1.96 std, cut
// at 0.
inline Quantity normal_quantity(double value, double std) {
  return {value, std, std::max(0.0, value - 1.96 * std), value + 1.96 * std};
}

// Whether the standard deviation exceeds half the value (or either is not a number).
inline bool is_undetermined(const Quantity& q) { return !(q.std <= 0.5 * q.value); }
// Undetermined, but with an interval that reaches 0: what is known is that the quantity is below
// high95. A deviation that is not known (the paper's method) sets no limit.
inline bool is_upper_limit(const Quantity& q) {
  return is_undetermined(q) && q.low95 <= 0.0 && std::isfinite(q.std) && std::isfinite(q.high95);
}

// The contribution of one cause to the uncertainty: the standard deviation whose square would
// vanish from the variance if the cause were known exactly (for "noise": by which it scatters the
// estimate, which takes on some to be less sensitive to other causes).
struct BudgetLine {
  std::string cause;  // "noise", "scale", or a nuisance's group
  double std_sigma_s_prime_per_mm = 0;
  double std_sigma_a_per_mm = 0;
};

// The pull of one uncertain quantity of the rig (core/fit/prior_pulls.h).
struct PriorPull {
  std::string name;           // of the nuisance, or "scale"
  std::string group;          // its line in the budget
  double pull = 0;            // standard normal if everything is as the rig states
  double offset = 0;          // most probable value minus the stated one, in the nuisance's unit
  double image_relative = 0;  // change of the image by the offset, relative to the image
  // What the other quantities leave of that change and the residual confirms: the part of the
  // residual that the offset explains, relative to the image.
  double explained_relative = 1;
  double std = 0;  // of the offset, by prior and images; joint pulls only
  // The smallest error of the stated value that the image shows, in the deviations of its prior:
  // that whose pull is kMostPull in the mean (Baarda 1968: the minimal detectable bias; at most
  // 4e6, where the image tells nothing). And by how much it shifts the estimate, to first order
  // (external reliability). 0 for joint pulls and for what is stated as exact.
  double least_seen_in_std = 0;
  double unseen_sigma_s_prime_per_mm = 0;
  double unseen_sigma_a_per_mm = 0;
};

struct Estimate {
  Quantity sigma_s_prime_per_mm;
  Quantity sigma_a_per_mm;
  double correlation = 0;  // between the two
  std::vector<BudgetLine> budget;
  Quantity scale;           // measured over predicted radiance, as fitted
  double reduced_chi2 = 0;  // of the image: residual^2 / variance, per degree of freedom
  double rms_relative = 0;  // rms residual over rms l
  double psnr_db = 0;       // 20 log10(largest l / rms residual), of the re-rendering
  // The part of the image that a smooth function of distance explains but this model does not: its
  // size relative to the image, and the probability of at least as much if the model holds.
  double misfit_relative = 0;
  double misfit_p_value = 1;
  std::vector<PriorPull> pulls;  // of the rig's uncertain quantities
  std::size_t rows = 0;          // number of rows used: patches times shots
  bool converged = false;
  // Why the numbers must not be trusted, as whole sentences; empty: they may be trusted.
  std::vector<std::string> reasons;
};

// Whether both coefficients differ from those of `to` by at most this share of its deviations.
bool is_near(const Estimate& estimate, const Estimate& to, double of_std);

// Adds an independent error in both coefficients to deviations, intervals, correlation and budget.
// by: its standard deviations, 1/mm; covariance: of the two, 1/mm^2.
void widen(const BudgetLine& by, double covariance, Estimate& estimate);

// Adds a reason to refuse for sigma_s' if it is undetermined (an upper limit is stated in it), and
// for sigma_a if it is undetermined and not an upper limit; none that is there already.
void refuse_undetermined(Estimate& estimate);

// Deviations as they would be with so many times the rows, were the others like these.
struct MoreRows {
  double times = 1;
  double std_sigma_s_prime_per_mm = 0;
  double std_sigma_a_per_mm = 0;
};

// Prior of the scale (LED power x camera gain x exposure).
struct ScalePrior {
  double relative_std = 0;  // 0: exact; infinity: free
  bool is_free() const { return !std::isfinite(relative_std); }
};

}  // namespace scattermeter
