#include "core/scene/scene.h"

#include <algorithm>
#include <stdexcept>

#include "core/base/input_error.h"

namespace scattermeter {
namespace {

template <class Named>
auto find_name(const std::vector<Named>& all, const std::string& name) {
  return std::find_if(all.begin(), all.end(), [&](const Named& n) { return n.name == name; });
}

template <class Named>
const Named& by_name(const std::vector<Named>& all, const std::string& name) {
  const auto it = find_name(all, name);
  if (it == all.end()) throw std::out_of_range("Scene: no such name: " + name);
  return *it;
}

}  // namespace

const Light& SceneLight::operator*() const {
  return std::visit([](const auto& light) -> const Light& { return light; }, kind);
}

const SceneObject& Scene::object(const std::string& name) const { return by_name(objects, name); }
const SceneLight& Scene::light(const std::string& name) const { return by_name(lights, name); }

std::string Scene::at(int line) const {
  return line > 0 ? source + ":" + std::to_string(line) : source;
}

void require_known_names(const Scene& scene) {
  for (const SceneShot& shot : scene.shots) {
    const std::string where = scene.at(shot.line) + ": shots." + shot.file;
    if (find_name(scene.objects, shot.object) == scene.objects.end()) {
      throw InputError(where + ".object", shot.object + " is not one of the objects");
    }
    if (shot.lights.empty()) throw InputError(where + ".lights", "expected at least one light");
    for (const std::string& name : shot.lights) {
      if (find_name(scene.lights, name) == scene.lights.end()) {
        throw InputError(where + ".lights", name + " is not one of the lights");
      }
    }
  }
}

std::vector<std::string> SceneShot::files() const {
  std::vector<std::string> all = {file};
  all.insert(all.end(), more_files.begin(), more_files.end());
  return all;
}

std::set<std::string> Scene::objects_in_shots() const {
  std::set<std::string> out;
  for (const SceneShot& shot : shots) out.insert(shot.object);
  return out;
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
