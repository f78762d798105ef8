#include "apps/bodies.h"

#include <utility>

namespace scattermeter::apps {
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

}  // namespace

TriangleMesh cube_mesh() {
  TriangleMesh mesh;
  add_square(mesh, 10, 0);
  add_square(mesh, 10, 20);
  add_quad(mesh, 3, 2, 1, 0);
  add_band(mesh, 0, 4);
  add_quad(mesh, 4, 5, 6, 7);
  return mesh;
}

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

}  // namespace scattermeter::apps
