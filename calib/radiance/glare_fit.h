// Veiling glare from black traps beside a bright patch.
#pragma once

#include <vector>

namespace scattermeter::calib {

// Mean of one trap in one shot and colour.
struct TrapMean {
  double counts = 0;        // above black, made linear
  double std_counts = 0;    // black's error included
  double frame_counts = 0;  // mean of the frame's
};

struct GlareFit {
  double share = 0;  // of the frame's mean, that every pixel gets; not below 0
  double std = 0;    // noise, and what traps differ by beyond it
  double rms_counts = 0, worst_counts = 0;
  bool ok = false;  // false: no trap in a frame with light
};

// share = trap / frame mean, weighted mean over the traps. The model is an even veil; a lens's
// glare is stronger near the patch, and traps at several distances show by how much: their scatter
// enters the standard deviation as it is, not divided by their number. model_relative_std widens
// it further. Precondition (std::invalid_argument): std_counts > 0.
GlareFit fit_glare(const std::vector<TrapMean>& traps, double model_relative_std);

}  // namespace scattermeter::calib
