#include "core/scene/scene.h"

#include <algorithm>
#include <stdexcept>

namespace scattermeter {
namespace {

template <class Named>
const Named& by_name(const std::vector<Named>& all, const std::string& name) {
  const auto it =
      std::find_if(all.begin(), all.end(), [&](const Named& n) { return n.name == name; });
  if (it == all.end()) throw std::out_of_range("Scene: no such name: " + name);
  return *it;
}

}  // namespace

const Light& SceneLight::operator*() const {
  return std::visit([](const auto& light) -> const Light& { return light; }, kind);
}

const SceneObject& Scene::object(const std::string& name) const { return by_name(objects, name); }
const SceneLight& Scene::light(const std::string& name) const { return by_name(lights, name); }

std::vector<std::string> SceneShot::files() const {
  std::vector<std::string> all = {file};
  all.insert(all.end(), more_files.begin(), more_files.end());
  return all;
}

std::vector<std::string> Scene::materials() const {
  std::vector<std::string> out;
  for (const SceneShot& shot : shots) {
    if (std::find(out.begin(), out.end(), shot.material) == out.end()) {
      out.push_back(shot.material);
    }
  }
  return out;
}

}  // namespace scattermeter
