// Maps of observation, model and difference of shots.
#pragma once

#include <string>
#include <vector>

#include "apps/instrument/measure.h"

namespace scattermeter::apps {

struct ChannelShot {
  const ShotRows* rows = nullptr;
  char channel = 'R';
};

// Rms of the differences over rms observed, of the rows in use; 0 without one.
double relative_rms(const ShotRows& rows);

// A round number of percent of the brightest row in use that 98 % of the differences do not exceed;
// 0 without a row in use.
double difference_scale_percent(const ShotRows& rows);

// The shots of these channels, at most so many of each that their data takes about `most_bytes`:
// those of the largest relative_rms() of any channel, in the order of the channel's.
std::vector<ChannelShot> shots_to_map(const std::vector<const ChannelResult*>& channels,
                                      std::size_t most_bytes);

// What apps/pages/web/residual_maps.js draws, as JSON: for each view the row of each place (packed
// by packed_integers.h, 0: none), reduced to a width of at most `width_px`, and for each shot the
// observed value in 0.01 % of the brightest row in use, observed minus predicted in hundredths of
// the full scale, and the state of each row.
std::string residual_map_data(const std::vector<ChannelShot>& shots, int width_px,
                              double full_scale_percent);

}  // namespace scattermeter::apps
