// A step of the search for a medium by the light of cells alone.
#pragma once

#include "core/fit/linear_shot.h"
#include "core/fit/scattering_equation.h"
#include "core/fit/shot_parts.h"

namespace scattermeter {

// The step of a ScatteringEquation whose rows are the cells of `parts`, some hundred instead of the
// system's many thousand, with the weights of `image` itself. Where paths are many it ends near the
// root of the rows' equation, at next to no cost; for an answer, its weights are too simple.
// image: simulated at `at`, at scale 1, on the rows of the system and the parts. scatter: as in
// ScatteringEquation::step().
ScatteringEquation::Step step_by_cells(const DenseSystem& system, const ShotParts& parts,
                                       const ScalePrior& scale, const ScatteringImage& image,
                                       const ScatteringPoint& at, double scatter);

}  // namespace scattermeter
