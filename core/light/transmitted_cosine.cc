#include "core/light/transmitted_cosine.h"

#include "core/material/fresnel.h"

namespace scattermeter {

TransmittedCosine::TransmittedCosine(double eta_int_over_ext) {
  for (int i = 0; i <= kSteps; ++i) {
    const double c = static_cast<double>(i) / kSteps;
    table_.push_back(c * fresnel_transmittance(eta_int_over_ext, c));
  }
}

}  // namespace scattermeter
