// Raw samples averaged to cells, for a coarse search.
#pragma once

#include "core/camera/cfa_samples.h"

namespace scattermeter::calib {

// Means of cells of factor x factor samples as one channel: pixel (x, y) of the result is centred
// at factor (x + 1/2) - 1/2 of the samples. Only whole cells are kept; a cell with a clipped sample
// is clipped. factor must be even and at least 2 (std::invalid_argument).
CfaSamples cell_means(const CfaSamples& samples, int factor);

}  // namespace scattermeter::calib
