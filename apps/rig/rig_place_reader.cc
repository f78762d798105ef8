#include "apps/rig/rig_place_reader.h"

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace scattermeter::apps {

void read_place(const YamlField& field, SceneObject& object) {
  field.only({"position_mm", "turn_deg", "from", "on_plane", "per_shot"});
  if (const auto f = field.find("position_mm")) {
    object.world_from_mesh.translation_mm = f->vector3();
  }
  if (const auto f = field.find("turn_deg")) {
    const Eigen::Vector3d rad = std::numbers::pi / 180.0 * f->vector3();
    object.world_from_mesh.rotation = Eigen::AngleAxisd(rad.z(), Eigen::Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(rad.y(), Eigen::Vector3d::UnitY()) *
                                      Eigen::AngleAxisd(rad.x(), Eigen::Vector3d::UnitX());
  }
  if (const auto f = field.find("from")) {
    const std::string from = f->text();
    if (from == "silhouette") {
      object.to_be_found.emplace();
    } else if (from != "stated") {
      f->fail("expected stated or silhouette");
    }
  }
  const auto read_flag = [&](const char* key, bool PieceSearch::*flag) {
    const auto f = field.find(key);
    if (!f) return;
    if (!object.to_be_found) f->fail("is for from: silhouette only");
    (*object.to_be_found).*flag = f->boolean();
  };
  read_flag("on_plane", &PieceSearch::is_on_plane);
  read_flag("per_shot", &PieceSearch::is_per_shot);
}

void separate_standings(Scene& scene) {
  std::vector<SceneObject> objects;
  for (const SceneObject& object : scene.objects) {
    const std::size_t before = objects.size();
    for (SceneShot& shot : scene.shots) {
      if (shot.object != object.name || !object.to_be_found || !object.to_be_found->is_per_shot) {
        continue;
      }
      objects.push_back(object);
      objects.back().piece = object.name;
      objects.back().name = shot.object = object.name + " in " + shot.file;
    }
    if (objects.size() == before) objects.push_back(object);
  }
  scene.objects = std::move(objects);
}

}  // namespace scattermeter::apps
