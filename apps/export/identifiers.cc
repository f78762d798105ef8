#include "apps/export/identifiers.h"

#include <algorithm>
#include <cctype>

namespace scattermeter::apps {

std::vector<std::string> identifiers(const std::vector<std::string>& names) {
  std::vector<std::string> out;
  for (const std::string& name : names) {
    std::string id;
    for (char c : name) id += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    if (id.empty() || std::isdigit(static_cast<unsigned char>(id.front())) != 0) id = "m_" + id;
    std::string unique = id;
    for (int n = 2; std::find(out.begin(), out.end(), unique) != out.end(); ++n) {
      unique = id + "_" + std::to_string(n);
    }
    out.push_back(unique);
  }
  return out;
}

}  // namespace scattermeter::apps
