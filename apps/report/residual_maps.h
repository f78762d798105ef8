// Pictures of observation, model and difference of a shot.
#pragma once

#include "apps/instrument/measure.h"
#include "apps/report/picture.h"

namespace scattermeter::apps {

struct ResidualMap {
  Picture picture;                // observed, model, difference
  double rms_relative = 0;        // of the difference, over rms observed
  double full_scale_percent = 0;  // of the difference, relative to the brightest row in use
};

// Draws the three pictures side by side. Rows that were not used are grey in model and difference;
// in the observation clipped ones are red and the others orange.
ResidualMap residual_map(const ShotRows& rows, int width_px);

}  // namespace scattermeter::apps
