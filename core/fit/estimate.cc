#include "core/fit/estimate.h"

#include <fmt/core.h>

namespace scattermeter {
namespace {

void add_once(std::string reason, std::vector<std::string>& reasons) {
  if (std::find(reasons.begin(), reasons.end(), reason) == reasons.end()) {
    reasons.push_back(std::move(reason));
  }
}

}  // namespace

void refuse_undetermined(Estimate& estimate) {
  const Quantity& s = estimate.sigma_s_prime_per_mm;
  const Quantity& a = estimate.sigma_a_per_mm;
  if (is_upper_limit(s)) {
    add_once(fmt::format("these shots do not determine sigma_s': it is below {:.2g} per mm, and "
                         "may be 0 (use more light, or a smaller piece)",
                         s.high95),
             estimate.reasons);
  } else if (is_undetermined(s)) {
    add_once(
        "these shots do not determine sigma_s' (no absolute scale and no light edge on the "
        "object, or too little light)",
        estimate.reasons);
  }
  if (!std::isfinite(a.std) || !std::isfinite(a.high95) || !std::isfinite(s.high95)) {
    add_once("these shots set no upper limit to a coefficient", estimate.reasons);
  } else if (is_undetermined(a) && !is_upper_limit(a)) {
    add_once(fmt::format("these shots do not determine sigma_a: {:.2g} +- {:.2g} per mm (expose "
                         "longer, or add shots under another LED)",
                         a.value, a.std),
             estimate.reasons);
  }
}

}  // namespace scattermeter
