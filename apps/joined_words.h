// Words in a row.
#pragma once

#include <string>
#include <vector>

namespace scattermeter::apps {

inline std::string joined_words(const std::vector<std::string>& words, const std::string& between) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

}  // namespace scattermeter::apps
