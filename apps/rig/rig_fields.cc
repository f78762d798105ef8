#include "apps/rig/rig_fields.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "capture/files/file_kind.h"
#include "core/base/nearest_name.h"

namespace scattermeter::apps {

std::string beside(const std::string& rig_path, const std::string& file) {
  const std::filesystem::path p(file);
  return p.is_absolute() ? file : (std::filesystem::path(rig_path).parent_path() / p).string();
}

std::string file_beside(const std::string& rig_path, const YamlField& field) {
  std::string path = beside(rig_path, field.text());
  if (!capture::is_there(path)) field.fail("there is no file " + path);
  return path;
}

std::string file_in_folder(const YamlField& field) {
  std::string name = field.text();
  if (name.find('/') != std::string::npos || name == "." || name == "..") {
    field.fail("expected the name of a file in the folder of shots, without a path");
  }
  return name;
}

std::array<double, 3> positive_rgb(const YamlField& field) {
  std::array<double, 3> out{};
  const std::vector<double> v = field.numbers(3);
  for (std::size_t c = 0; c < 3; ++c) {
    if (!(v[c] > 0.0)) field.fail("expected three positive numbers (R, G, B)");
    out[c] = v[c];
  }
  return out;
}

std::array<double, 3> rgb_not_negative(const YamlField& field) {
  std::array<double, 3> out{};
  const std::vector<double> v = field.numbers(3);
  for (std::size_t c = 0; c < 3; ++c) {
    if (!(v[c] >= 0.0)) field.fail("expected three numbers of at least 0 (R, G, B)");
    out[c] = v[c];
  }
  return out;
}

Eigen::Vector3d unit_vector(const YamlField& field) {
  const Eigen::Vector3d v = field.vector3();
  if (!(v.norm() > 0.0)) field.fail("expected a direction other than zero");
  return v.normalized();
}

std::array<int, 2> integer_pair(const YamlField& field, int min, int max) {
  field.numbers(2);
  const std::vector<YamlField> items = field.items();
  return {items[0].integer(min, max), items[1].integer(min, max)};
}

Eigen::Array3d some_light(const YamlField& field) {
  const Eigen::Array3d rgb(rgb_not_negative(field).data());
  if (!(rgb.maxCoeff() > 0.0)) field.fail("expected light in at least one channel");
  return rgb;
}

calib::BoardViewpoint read_viewpoint(const YamlField& field) {
  calib::BoardViewpoint out{field.at("position_mm").vector3(), field.at("look_at_mm").vector3()};
  if (const auto f = field.find("up")) out.up = unit_vector(*f);
  const Eigen::Vector3d forward = out.look_at_mm - out.position_mm;
  if (!(forward.cross(out.up).norm() > 1e-9 * forward.norm())) {
    field.fail("position_mm, look_at_mm and up do not define a camera");
  }
  return out;
}

double exposure_time_s(const YamlField& field) { return field.number(1e-9, 1e6); }

void require_name(const YamlField& field, const std::vector<std::string>& names,
                  const std::string& what) {
  const std::string name = field.text();
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  field.fail(what, did_you_mean(name, names));
}

void require_mm(const YamlField& field, double length_mm, double shortest_mm) {
  if (length_mm > 0.0 && length_mm < shortest_mm) {
    field.fail("lengths are in mm, and this one looks like metres");
  }
}

void require_version(const YamlField& top, const std::string& key, const std::string& what) {
  const auto version = top.find(key);
  if (!version) top.fail("expected a line \"" + key + ": 1\", as in all " + what);
  if (version->number() != 1.0) version->fail("this program reads " + what + " of version 1");
}

}  // namespace scattermeter::apps
