#include "apps/bodies.h"

#include <numbers>
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

TriangleMesh sphere_mesh(int levels) {
  constexpr double kRadius_mm = 10.0;
  const double phi = std::numbers::phi;
  TriangleMesh mesh;
  mesh.vertices_mm = {{-1, phi, 0}, {1, phi, 0}, {-1, -phi, 0}, {1, -phi, 0},
                      {0, -1, phi}, {0, 1, phi}, {0, -1, -phi}, {0, 1, -phi},
                      {phi, 0, -1}, {phi, 0, 1}, {-phi, 0, -1}, {-phi, 0, 1}};
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  mesh = cut_finer(std::move(mesh), levels);
  for (Eigen::Vector3d& v : mesh.vertices_mm) {
    v = kRadius_mm * v.normalized() + Eigen::Vector3d(0, 0, kRadius_mm);
  }
  return mesh;
}

}  // namespace scattermeter::apps
