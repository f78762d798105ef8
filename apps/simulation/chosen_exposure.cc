#include "apps/simulation/chosen_exposure.h"

#include <fmt/core.h>

#include "core/base/input_error.h"

namespace scattermeter::apps {

double full_exposure_s(const std::string& rig_path, double exact_s) {
  constexpr double kShortest_s = 1e-9, kLongest_s = 1e9;
  if (!(exact_s > kShortest_s && exact_s < kLongest_s)) {
    throw InputError(rig_path + ": camera.exposure_s",
                     fmt::format("is missing, and full exposure would take {:.2g} s: check the "
                                 "lights' intensities and "
                                 "camera.responsivity_counts_mm2_sr_per_W_s",
                                 exact_s));
  }
  return rounded_exposure_s(exact_s);
}

}  // namespace scattermeter::apps
