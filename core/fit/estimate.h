// The result of every estimator.
#pragma once

#include <algorithm>
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

// What one cause adds to the uncertainty: the standard deviation whose square would vanish from the
// variance if the cause were known exactly (for "noise": what is left when all others are).
struct BudgetLine {
  std::string cause;  // "noise", "scale", or a nuisance's group
  double std_sigma_s_prime_per_mm = 0;
  double std_sigma_a_per_mm = 0;
};

struct Estimate {
  Quantity sigma_s_prime_per_mm;
  Quantity sigma_a_per_mm;
  double correlation = 0;  // between the two
  std::vector<BudgetLine> budget;
  Quantity scale;           // measured over predicted radiance that the fit settled on
  double reduced_chi2 = 0;  // of the image: residual^2 / variance, per degree of freedom
  double rms_relative = 0;  // rms residual over rms l
  double psnr_db = 0;       // 20 log10(largest l / rms residual), of the re-rendering
  // What a smooth function of distance explains of the image and this model's does not: its size
  // relative to the image, and how probable at least as much of it were if the model held.
  double misfit_relative = 0;
  double misfit_p_value = 1;
  std::size_t rows = 0;  // patches times shots that took part
  bool converged = false;
  // Why the numbers must not be trusted; empty: they may. Whole sentences.
  std::vector<std::string> reasons;
};

// How much the scale (LED power x camera gain x exposure) is known.
struct ScalePrior {
  double relative_std = 0;  // 0: exact; infinity: free
};

}  // namespace scattermeter
