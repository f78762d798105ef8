#include "capture/sensor/exposure_departure.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace scattermeter::capture {

std::vector<ExposureDeparture> exposure_departures(const std::vector<CfaSamples>& exposures,
                                                   const CfaSamples& merged) {
  if (merged.part_of_exposure.size() != exposures.size()) {
    throw std::invalid_argument("exposure_departures: the samples were not merged from these");
  }
  std::vector<ExposureDeparture> out;
  for (std::size_t k = 0; k < exposures.size(); ++k) {
    double own = 0, own_variance = 0, other = 0, other_variance = 0, n = 0;
    for (std::size_t i = 0; i < merged.clipped.size(); ++i) {
      if (!(merged.part_of_exposure[k][i] > 0.0F)) continue;
      double counts = 0, variance = 0, time_s = 0;
      for (std::size_t j = 0; j < exposures.size(); ++j) {
        if (j == k || !(merged.part_of_exposure[j][i] > 0.0F)) continue;
        counts += static_cast<double>(exposures[j].signal_counts[i]);
        variance += static_cast<double>(exposures[j].variance_counts2[i]);
        time_s += exposures[j].exposure_s;
      }
      if (!(time_s > 0.0)) continue;
      const double as_long = exposures[k].exposure_s / time_s;
      own += static_cast<double>(exposures[k].signal_counts[i]);
      own_variance += static_cast<double>(exposures[k].variance_counts2[i]);
      other += as_long * counts;
      other_variance += as_long * as_long * variance;
      n += 1.0;
    }
    ExposureDeparture& departure = out.emplace_back();
    if (!(own > 0.0) || !(other > 0.0)) {
      departure.log_ratio = departure.noise_std = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    departure.log_ratio = std::log(own / other);
    departure.noise_std = std::sqrt(own_variance / (own * own) + other_variance / (other * other));
    departure.mean_counts = own / n;
  }
  return out;
}

}  // namespace scattermeter::capture
