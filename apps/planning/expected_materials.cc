#include "apps/planning/expected_materials.h"

#include <cmath>
#include <stdexcept>

#include <fmt/core.h>

#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

void require_range(const char* name, const std::optional<ExpectedRange>& range) {
  if (!range || (range->low >= 0.0 && range->low <= range->high && std::isfinite(range->high))) {
    return;
  }
  throw std::invalid_argument(
      fmt::format("plan: {} from {} to {} is not a range", name, range->low, range->high));
}

}  // namespace

std::vector<TruthMaterials> expected_materials(const Rig& rig,
                                               const std::optional<ExpectedRange>& sigma_s_prime,
                                               const std::optional<ExpectedRange>& sigma_a) {
  require_range("sigma_s'", sigma_s_prime);
  require_range("sigma_a", sigma_a);
  if (sigma_s_prime && !(sigma_s_prime->low > 0.0)) {
    throw std::invalid_argument("plan: sigma_s' from 0");
  }
  // Fractions of the ranges: 0 is the low end, 1 the high end.
  const auto at = [&](double s_fraction, double a_fraction) {
    TruthMaterials out;
    for (const std::string& material : rig.scene.materials()) {
      std::array<Medium, 3>& media = out[material];
      const auto truth = rig.truth.materials.find(material);
      if (truth != rig.truth.materials.end()) {
        media = truth->second;
      } else if (!sigma_s_prime || !sigma_a) {
        throw InputError(
            rig.path + ": truth.materials." + material,
            "is missing: without it, state what to expect (--sigma-s-prime, --sigma-a)");
      }
      for (Medium& m : media) {
        if (sigma_s_prime) {
          m.sigma_s_prime_per_mm =
              sigma_s_prime->low * std::pow(sigma_s_prime->high / sigma_s_prime->low, s_fraction);
        }
        if (sigma_a) {
          m.sigma_a_per_mm = sigma_a->low + a_fraction * (sigma_a->high - sigma_a->low);
        }
      }
    }
    return out;
  };
  const auto ends = [](const std::optional<ExpectedRange>& range) {
    return range && range->low < range->high ? std::vector<double>{0.0, 1.0}
                                             : std::vector<double>{0.0};
  };
  std::vector<TruthMaterials> out = {at(0.5, 0.5)};
  for (const double s_fraction : ends(sigma_s_prime)) {
    for (const double a_fraction : ends(sigma_a)) out.push_back(at(s_fraction, a_fraction));
  }
  // A single corner is the middle.
  if (out.size() == 2) out.pop_back();
  return out;
}

}  // namespace scattermeter::apps
