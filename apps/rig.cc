#include "apps/rig.h"

#include <algorithm>
#include <stdexcept>

namespace scattermeter::apps {
namespace {

template <class Named>
const Named& by_name(const std::vector<Named>& all, const std::string& name) {
  const auto it =
      std::find_if(all.begin(), all.end(), [&](const Named& n) { return n.name == name; });
  if (it == all.end()) throw std::out_of_range("Rig: no such name: " + name);
  return *it;
}

}  // namespace

const RigObject& Rig::object(const std::string& name) const { return by_name(objects, name); }
const RigLight& Rig::light(const std::string& name) const { return by_name(lights, name); }

std::vector<std::string> RigShot::files() const {
  std::vector<std::string> all = {file};
  all.insert(all.end(), more_files.begin(), more_files.end());
  return all;
}

std::vector<std::string> Rig::materials() const {
  std::vector<std::string> out;
  for (const RigShot& shot : shots) {
    if (std::find(out.begin(), out.end(), shot.material) == out.end()) {
      out.push_back(shot.material);
    }
  }
  return out;
}

}  // namespace scattermeter::apps
