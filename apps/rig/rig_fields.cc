#include "apps/rig/rig_fields.h"

#include <filesystem>
#include <vector>

namespace scattermeter::apps {

std::string beside(const std::string& rig_path, const std::string& file) {
  const std::filesystem::path p(file);
  return p.is_absolute() ? file : (std::filesystem::path(rig_path).parent_path() / p).string();
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

}  // namespace scattermeter::apps
