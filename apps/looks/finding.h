// Something wrong with rig or shots that a look before any fit shows.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace scattermeter::apps {

struct Finding {
  std::string cause;               // "mesh displaced": the class, for tables
  std::string text;                // what was seen, with amounts; starts with the class
  std::string advice;              // what a user should do
  std::vector<std::size_t> shots;  // that cannot be measured, as indices into the scene's
  std::string sentence() const { return text + "; " + advice; }
};

}  // namespace scattermeter::apps
