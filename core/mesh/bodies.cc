#include "core/mesh/bodies.h"

#include <stdexcept>
#include <utility>

#include "core/mesh/round_bodies.h"

namespace scattermeter {
namespace {

// Cuts a quadrilateral, counter-clockwise from outside, in two.
void add_quad(TriangleMesh& mesh, int a, int b, int c, int d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

// Four corners of a square about the z axis, counter-clockwise from above.
void add_square(TriangleMesh& mesh, double half_mm, double z_mm) {
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    mesh.vertices_mm.emplace_back(x * half_mm, y * half_mm, z_mm);
  }
}

// Bands between neighbouring squares, from the first to the last; `first` below.
void add_band(TriangleMesh& mesh, int lower, int upper) {
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    add_quad(mesh, lower + i, lower + j, upper + j, upper + i);
  }
}

// Square, on z = 0.
TriangleMesh block(double width_mm, double height_mm) {
  TriangleMesh mesh;
  add_square(mesh, 0.5 * width_mm, 0);
  add_square(mesh, 0.5 * width_mm, height_mm);
  add_quad(mesh, 3, 2, 1, 0);
  add_band(mesh, 0, 4);
  add_quad(mesh, 4, 5, 6, 7);
  return mesh;
}

}  // namespace

TriangleMesh cube_mesh() { return block(20, 20); }

TriangleMesh slab_mesh() { return block(40, 10); }

TriangleMesh pyramid_on_pedestal_mesh() {
  TriangleMesh mesh;
  add_square(mesh, 11, 0);
  add_square(mesh, 11, 7);
  add_square(mesh, 8, 7);
  mesh.vertices_mm.emplace_back(0, 0, 20);
  add_quad(mesh, 3, 2, 1, 0);
  add_band(mesh, 0, 4);
  add_band(mesh, 4, 8);
  for (int i = 0; i < 4; ++i) mesh.triangles.push_back({8 + i, 8 + (i + 1) % 4, 12});
  return mesh;
}

TriangleMesh pyramid_mesh() {
  TriangleMesh mesh;
  add_square(mesh, 10, 0);
  mesh.vertices_mm.emplace_back(0, 0, 20);
  add_quad(mesh, 3, 2, 1, 0);
  for (int i = 0; i < 4; ++i) mesh.triangles.push_back({i, (i + 1) % 4, 4});
  return mesh;
}

const std::vector<std::string>& body_names() {
  static const std::vector<std::string> names = {"cube", "pyramid", "sphere", "slab", "scan"};
  return names;
}

TriangleMesh body_mesh(const std::string& name) {
  if (name == "cube") return cube_mesh();
  if (name == "pyramid") return pyramid_on_pedestal_mesh();
  if (name == "sphere") return sphere_mesh();
  if (name == "slab") return slab_mesh();
  if (name == "scan") return scanned_mesh();
  throw std::invalid_argument("body_mesh: no body '" + name + "'");
}

}  // namespace scattermeter
