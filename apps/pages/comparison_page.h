// The comparison of two results as an HTML page.
#pragma once

#include <string>
#include <vector>

#include "apps/results/comparison.h"

namespace scattermeter::apps {

// The verdict on each pair of materials, the coefficients with their differences, and a plot of
// these. first, second: the files; rigs: how errors that both may share were counted.
std::string comparison_page(const std::vector<MaterialComparison>& materials,
                            const std::string& first, const std::string& second,
                            const std::string& rigs, const std::string& command_line);

}  // namespace scattermeter::apps
