// Known materials that a measured one is compared with.
#pragma once

#include <string>
#include <vector>

#include "apps/results/comparison.h"
#include "apps/results/result_reader.h"

namespace scattermeter::apps {

// Relative standard deviation of published coefficients, of which the authors state none.
inline constexpr double kPublishedStd = 0.1;

// The materials of core/material/published_media.h as a result, with kPublishedStd and the rounding
// of their last digit; its path is the authors' name.
ReadResult published_library();

struct ResultFolder {
  std::vector<ReadResult> results;    // in the order of their paths
  std::vector<std::string> left_out;  // other JSON files
};
// All results in a folder and the folders below it (*.json), but not the file `except`. Throws
// InputError for a folder that cannot be read or holds no result.
ResultFolder results_in(const std::string& folder, const std::string& except);

struct LibraryMatch {
  std::string of;  // path of the result that holds the known material
  MaterialComparison comparison;
  // How unlike both look: root mean square, over the channels, of ln of the ratio of sigma_s' and
  // half of that of sigma_a, as diffuse reflectance goes with sqrt(sigma_a / sigma_s'). sigma_a
  // counts as 1e-4 /mm at least.
  double distance = 0;
};

// The known materials with a channel in common with this one, the likest first.
std::vector<LibraryMatch> matches(const ReadResult& result, const std::string& material,
                                  const std::vector<ReadResult>& library);

}  // namespace scattermeter::apps
