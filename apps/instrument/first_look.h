// Findings of the looks before any fit, in the order of probability, and the results that they
// refuse.
#pragma once

#include <vector>

#include "apps/instrument/finding.h"
#include "core/estimation/estimation.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

// The findings of the outlines, then those of the light that are not their consequences: the light
// of a shot whose outline is wrong is judged only where the lights themselves are at fault.
std::vector<Finding> in_order(std::vector<Finding> of_outlines, std::vector<Finding> of_light);

// Adds the findings that concern a channel's shots to the reasons of its result, at most two: the
// first is the most probable.
void refuse(const Scene& scene, const std::vector<Finding>& findings, Estimation& estimation);

}  // namespace scattermeter::apps
