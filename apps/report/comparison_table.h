// The comparison of two results, or of one with known materials, as a table for the terminal.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/results/comparison.h"
#include "apps/results/material_library.h"

namespace scattermeter::apps {

// One line for each channel, the difference with its standard deviation and p value, then a verdict
// in words for each pair of materials.
std::string comparison_table(const std::vector<MaterialComparison>& materials);

// "PP and PE: different (p = 0.0001)", or that none was found and what would have been seen.
std::string comparison_sentence(const MaterialComparison& material);

// The `most` likest known materials, one line each: differences of sigma_s' and sigma_a by channel,
// whether they are beyond the errors, then a sentence about the likest. matches: of the material
// `name`, in order.
std::string library_table(const std::string& name, const std::vector<LibraryMatch>& matches,
                          std::size_t most = 5);

}  // namespace scattermeter::apps
