// A list of known materials by name and channel.
#pragma once

#include <string>
#include <vector>

#include "core/material/medium.h"

namespace scattermeter::apps {

struct ListedMaterial {
  std::string name;
  char channel = 'R';  // R, G, B
  Medium medium;
};

// Reads a CSV file with the columns name, channel, eta, sigma_s_prime_per_mm and sigma_a_per_mm in
// any order; other columns are ignored. Throws InputError naming file, line, column and value for a
// missing column, a channel other than R, G, B or given twice, different eta within a name, or a
// value that is not a number or out of range (eta in 0.5 .. 4, sigma_s' > 0, sigma_a > 0).
std::vector<ListedMaterial> read_materials(const std::string& path);

// Four materials over the range of the instrument: marble, skim milk, skin 1, ketchup
// (core/material/published_media.h).
const std::vector<ListedMaterial>& well_known_materials();

}  // namespace scattermeter::apps
