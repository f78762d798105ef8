// Veiling glare from black traps beside a bright patch.
#pragma once

#include <vector>

namespace scattermeter::calib {

// Mean of one trap in one shot and colour.
struct TrapMean {
  double counts = 0;        // above black, made linear
  double std_counts = 0;    // including the error of black
  double frame_counts = 0;  // mean over the frame
};

struct GlareFit {
  double share = 0;  // of the frame mean, added to every pixel; not below 0
  double std = 0;    // noise, and the scatter between traps beyond it
  double rms_counts = 0, worst_counts = 0;
  bool ok = false;  // false: no trap in a frame with light
};

// share = trap / frame mean, as weighted mean over the traps. The model is a uniform veil; the
// glare of a lens is stronger near the patch, and traps at several distances show by how much:
// their scatter is added to the standard deviation without division by their number.
// model_relative_std increases it further. Throws std::invalid_argument unless std_counts > 0.
GlareFit fit_glare(const std::vector<TrapMean>& traps, double model_relative_std);

}  // namespace scattermeter::calib
