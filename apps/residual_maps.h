// What a shot shows, what the model makes of it, and the difference, side by side.
#pragma once

#include "apps/measure.h"
#include "apps/picture.h"

namespace scattermeter::apps {

struct ResidualMap {
  Picture picture;                // observed, model, difference
  double rms_relative = 0;        // of the difference, over rms observed
  double full_scale_percent = 0;  // of the difference's colours, of the brightest place in use
};

// Rows that took no part: grey in the model and the difference; clipped ones red, others that were
// left out orange in the observed image.
ResidualMap residual_map(const ShotRows& rows, int width_px);

}  // namespace scattermeter::apps
