#include <algorithm>

#include "apps/checking/check.h"

namespace scattermeter::apps {

std::vector<CheckItem> check_exposure(const CheckedRig& checked) {
  std::vector<CheckDetail> clipped, brightest;
  for (std::size_t i = 0; i < checked.shots.size(); ++i) {
    for (std::size_t c = 0; c < kRgb; ++c) {
      const ChannelObservation& o = checked.shots[i].observation.channel[c];
      const double samples = std::max<double>(1.0, static_cast<double>(o.samples));
      clipped.push_back(
          checked.of_channel(i, c, 100.0 * static_cast<double>(o.samples_clipped) / samples));
      // If everything is clipped, it is not dark.
      const bool all_clipped = o.rows_clipped == o.l.size() && !o.l.empty();
      if (!all_clipped) brightest.push_back(checked.of_channel(i, c, o.brightest_snr));
    }
  }
  return {judged("clipped", "% of samples", {checked.options.max_clipped_percent}, "expose shorter",
                 clipped),
          judged("brightest patch", "x its noise", {checked.options.min_brightest_snr, true},
                 "expose longer, or check whether the LED was on", brightest)};
}

}  // namespace scattermeter::apps
