// A measurement in a few sentences.
#pragma once

#include <string>

#include "apps/instrument/measure.h"

namespace scattermeter::apps {

// "sigma_s' is known to 0.20 … 0.22 %, sigma_a to 0.33 … 0.49 % (one standard deviation)." of the
// values that were not refused, upper limits aside; "" without one.
std::string precision_sentence(const Measurement& measurement);

// "3 of 9 values rest on what the rig states and these shots cannot test: scale (PP R, PP G); LED
// power (PE B)."; "" where none does.
std::string rests_on_sentence(const Measurement& measurement);

// What to do next: which cause of uncertainty is the largest in most of the measured values, or
// that reasons of refusals come first.
std::string next_sentence(const Measurement& measurement);

}  // namespace scattermeter::apps
