// The answers of `bench silicones` as tables.
#pragma once

#include <string>
#include <vector>

#include "apps/deviations/silicones.h"

namespace scattermeter::apps {

// Of one body and number of images.
struct SiliconeSummary {
  std::string body;
  int images = 1;
  int answers = 0, answered = 0, wrong_ok = 0;
  int in_interval = 0;  // of 2 * answered intervals of 95 %
  // Over what is answered; 0 where nothing is.
  double largest_scattering = 0, largest_absorption = 0;                    // |error|, relative
  double root_mean_square_scattering = 0, root_mean_square_absorption = 0;  // relative
  double colour_difference = 0;                                             // the largest
};
// In the order in which they occur.
std::vector<SiliconeSummary> summarise(const std::vector<SiliconeResult>& results);

// A row for each silicone and channel.
std::string silicones_table(const std::vector<SiliconeResult>& results);
// A row for each body and number of images, the published figures beside it.
std::string silicones_summary_table(const std::vector<SiliconeResult>& results);
// A row for each answer.
std::string silicones_csv(const std::vector<SiliconeResult>& results);

}  // namespace scattermeter::apps
