#include "apps/drafting/drafted_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "apps/drafting/listed_numbers.h"
#include "capture/files/obj_reader.h"
#include "core/base/input_error.h"
#include "core/base/nearest_name.h"
#include "core/mesh/bodies.h"
#include "core/mesh/round_bodies.h"

namespace scattermeter::apps {
namespace {

struct Shape {
  const char* name;
  std::function<TriangleMesh()> mesh;
};
const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all = {{"cube", cube_mesh},
                                         {"box", cube_mesh},
                                         {"slab", slab_mesh},
                                         {"pyramid", pyramid_mesh},
                                         {"cylinder", [] { return cylinder_mesh(); }},
                                         {"sphere", [] { return sphere_mesh(5); }}};
  return all;
}

// "20" or "30x20x10".
Eigen::Vector3d size_of(std::string_view text, const std::string& whole) {
  const std::vector<double> sizes = listed_numbers(text, 'x', "--body", whole);
  const bool fits = sizes.size() == 1 || sizes.size() == 3;
  if (fits && std::all_of(sizes.begin(), sizes.end(), [](double s) { return s > 0.0; })) {
    return {sizes.front(), sizes[sizes.size() / 2], sizes.back()};
  }
  throw InputError("--body", fmt::format("needs one size or three in mm, as in cube:20 or "
                                         "box:30x20x10, got {}",
                                         whole));
}

}  // namespace

DraftedBody drafted_body(const std::string& text) {
  if (text.ends_with(".obj")) {
    return {std::filesystem::path(text).stem().string(), capture::read_obj(text)};
  }
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  std::vector<std::string> names;
  for (const Shape& shape : shapes()) {
    names.emplace_back(shape.name);
    if (name != shape.name) continue;
    const Eigen::Vector3d size_mm =
        size_of(colon == std::string::npos ? "" : std::string_view(text).substr(colon + 1), text);
    DraftedBody out{name, shape.mesh()};
    const Eigen::Vector3d scale = size_mm.cwiseQuotient(bounds(out.mesh).size_mm());
    for (Eigen::Vector3d& v : out.mesh.vertices_mm) v = v.cwiseProduct(scale);
    if (const std::string problem = mesh_problem(out.mesh); !problem.empty()) {
      throw InputError("--body", problem + ", got " + text);
    }
    return out;
  }
  throw InputError("--body",
                   fmt::format("must be a mesh (.obj) or one of {} with its size, got {}{}",
                               fmt::join(names, ", "), text, did_you_mean(name, names)));
}

std::string obj_text(const TriangleMesh& mesh) {
  std::string out = "# Lengths in mm, z up.\n";
  for (const Eigen::Vector3d& v : mesh.vertices_mm) {
    out += fmt::format("v {:.9g} {:.9g} {:.9g}\n", v.x(), v.y(), v.z());
  }
  for (const std::array<int, 3>& t : mesh.triangles) {
    out += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  }
  return out;
}

}  // namespace scattermeter::apps
