// The cosine times the Fresnel transmittance of a surface, tabulated.
#pragma once

#include <vector>

namespace scattermeter {

// cos * Ft(eta, cos) from a table, for sums over many directions. Within 1e-7 of the Fresnel
// equations for eta = 1 and 1.05 <= eta <= 4.
class TransmittedCosine {
 public:
  // std::invalid_argument for eta <= 0.
  explicit TransmittedCosine(double eta_int_over_ext);

  // 0 for a cosine of 0 or below; cosines above 1 count as 1.
  double operator()(double cos_theta) const {
    if (!(cos_theta > 0.0)) return 0.0;
    if (cos_theta >= 1.0) return table_[kSteps];
    const double at = cos_theta * kSteps;
    const int i = static_cast<int>(at);
    return table_[static_cast<std::size_t>(i)] +
           (at - i) *
               (table_[static_cast<std::size_t>(i) + 1] - table_[static_cast<std::size_t>(i)]);
  }

 private:
  static constexpr int kSteps = 16384;
  std::vector<double> table_;
};

}  // namespace scattermeter
