// Raw samples averaged over cells, for a coarse search.
#pragma once

#include "core/camera/cfa_samples.h"

namespace scattermeter::calib {

// Means over cells of factor x factor samples, as one channel: pixel (x, y) of the result is
// centred at sample coordinates factor (x + 1/2) - 1/2, and likewise for y. Only whole cells are
// kept; a cell with a clipped sample is clipped. Throws std::invalid_argument unless factor is even
// and at least 2.
CfaSamples cell_means(const CfaSamples& samples, int factor);

}  // namespace scattermeter::calib
