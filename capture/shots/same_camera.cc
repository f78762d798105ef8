#include "capture/shots/same_camera.h"

#include <algorithm>
#include <cctype>

namespace scattermeter::capture {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

bool same_camera(const std::string& wanted, const std::string& make, const std::string& model) {
  const std::string w = lower(wanted);
  const std::string m = lower(model);
  return w == m || w == lower(make) + " " + m;
}

}  // namespace scattermeter::capture
