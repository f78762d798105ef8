// The comparison of two results as a table for the terminal.
#pragma once

#include <string>
#include <vector>

#include "apps/results/comparison.h"

namespace scattermeter::apps {

// One line for each channel, the difference with its standard deviation and p value, then a verdict
// in words for each pair of materials.
std::string comparison_table(const std::vector<MaterialComparison>& materials);

}  // namespace scattermeter::apps
