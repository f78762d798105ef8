// Pictures of observation, model and difference of a shot.
#pragma once

#include "apps/instrument/measure.h"
#include "apps/report/picture.h"

namespace scattermeter::apps {

struct ResidualMap {
  Picture picture;          // observed, model, difference
  double rms_relative = 0;  // of the difference, over rms observed
};

// A round number of percent of the brightest row in use that 98 % of the differences do not exceed;
// 0 without a row in use.
double difference_scale_percent(const ShotRows& rows);

// Draws the three pictures side by side, the difference from blue at -full_scale_percent to red at
// +full_scale_percent of the brightest row in use. Rows that were not used are grey in model and
// difference; in the observation clipped ones are red and the others orange. At most 256 colours.
ResidualMap residual_map(const ShotRows& rows, int width_px, double full_scale_percent);

}  // namespace scattermeter::apps
