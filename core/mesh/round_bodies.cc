#include "core/mesh/round_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/random_stream.h"

namespace scattermeter {
namespace {

// Of radius 1 about the origin; 20 * 4^levels triangles.
TriangleMesh unit_sphere(int levels) {
  constexpr double kPhi = std::numbers::phi;
  TriangleMesh mesh;
  mesh.vertices_mm = {{-1, kPhi, 0}, {1, kPhi, 0}, {-1, -kPhi, 0}, {1, -kPhi, 0},
                      {0, -1, kPhi}, {0, 1, kPhi}, {0, -1, -kPhi}, {0, 1, -kPhi},
                      {kPhi, 0, -1}, {kPhi, 0, 1}, {-kPhi, 0, -1}, {-kPhi, 0, 1}};
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0;; ++level) {
    for (Eigen::Vector3d& v : mesh.vertices_mm) v.normalize();
    if (level == levels) return mesh;
    mesh = cut_finer(mesh, 1);
  }
}

// Raises the surface by `height` (of the mean radius) towards `towards`; down to 1/e at an angle
// whose cosine is 1 - 1 / narrowness.
struct Bump {
  Eigen::Vector3d towards;
  double height;
  double narrowness;
};

const std::array<Bump, 9>& bumps() {
  static const std::array<Bump, 9> list = {{{{0.2, -0.7, 0.7}, -0.22, 9.0},
                                            {{-0.8, -0.4, 0.4}, 0.20, 6.0},
                                            {{0.9, -0.2, 0.3}, 0.16, 8.0},
                                            {{-0.1, 0.3, 0.95}, 0.14, 10.0},
                                            {{-0.5, -0.8, -0.2}, -0.16, 12.0},
                                            {{0.6, 0.7, 0.4}, -0.14, 7.0},
                                            {{0.5, -0.8, -0.1}, 0.12, 14.0},
                                            {{-0.6, 0.7, -0.2}, 0.18, 5.0},
                                            {{0.1, 0.1, -1.0}, -0.12, 4.0}}};
  return list;
}

// Puts the body on z = 0, its box centred on the z axis.
void set_down(TriangleMesh& mesh) {
  const Box3d box = bounds(mesh);
  const Eigen::Vector3d foot(box.center_mm().x(), box.center_mm().y(), box.min_mm.z());
  for (Eigen::Vector3d& v : mesh.vertices_mm) v -= foot;
}

constexpr double kRadius_mm = 10.0;
constexpr double kHeight_mm = 20.0;
constexpr int kCornersOfFirstCircle = 6;

// Corners of a mesh on a circle about the z axis.
struct Ring {
  int first;
  int corners;
  int operator[](int i) const { return first + i % corners; }
};
Ring add_ring(TriangleMesh& mesh, int corners, double radius_mm, double z_mm) {
  const Ring out{static_cast<int>(mesh.vertices_mm.size()), corners};
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    mesh.vertices_mm.emplace_back(radius_mm * std::cos(angle), radius_mm * std::sin(angle), z_mm);
  }
  return out;
}

// The band between two rings, which faces outwards where `b` is above `a`, and up where `b` is
// inside of it.
void join(TriangleMesh& mesh, const Ring& a, const Ring& b) {
  int i = 0, j = 0;
  const int of_b = b.corners > 1 ? b.corners : 0;
  const int of_a = a.corners > 1 ? a.corners : 0;
  while (i < of_a || j < of_b) {
    // The next corner by angle.
    if (j == of_b || (i < of_a && (i + 1) * b.corners <= (j + 1) * a.corners)) {
      mesh.triangles.push_back({a[i], a[i + 1], b[j]});
      ++i;
    } else {
      mesh.triangles.push_back({a[i], b[j + 1], b[j]});
      ++j;
    }
  }
}

}  // namespace

TriangleMesh sphere_mesh(int levels) {
  TriangleMesh mesh = unit_sphere(levels);
  // The icosphere's lowest point is the midpoint of an edge, where a subdivided sphere has a
  // corner.
  for (Eigen::Vector3d& v : mesh.vertices_mm) v = 10.0 * v + Eigen::Vector3d(0, 0, 10);
  return mesh;
}

TriangleMesh cylinder_mesh(int sides) {
  // Bands of a side and circles of a cap: facets are some four times as long as a side is wide.
  constexpr int kSidesPerBand = 12;
  const int bands = std::max(1, sides / kSidesPerBand);
  TriangleMesh mesh;
  std::vector<Ring> rims;
  for (int k = 0; k <= bands; ++k) {
    rims.push_back(add_ring(mesh, sides, kRadius_mm, kHeight_mm * k / bands));
    if (k > 0) join(mesh, rims[rims.size() - 2], rims.back());
  }
  for (const Ring& rim : {rims.front(), rims.back()}) {
    const double z_mm = mesh.vertices_mm[static_cast<std::size_t>(rim.first)].z();
    Ring outer = rim;
    for (int k = bands - 1; k >= 0; --k) {
      const int corners = k == 0 ? 1 : std::min(sides, kCornersOfFirstCircle * k);
      const Ring inner = add_ring(mesh, corners, kRadius_mm * k / bands, z_mm);
      if (z_mm > 0.0) {
        join(mesh, outer, inner);
      } else {
        join(mesh, inner, outer);
      }
      outer = inner;
    }
  }
  return mesh;
}

TriangleMesh scanned_mesh() {
  constexpr int kLevels = 5;
  // Of an edge; corners that move by less than 0.43 (half a height) turn no triangle over.
  constexpr double kJitter = 0.2;
  const double edge = 1.1 / (1 << kLevels);
  TriangleMesh mesh = unit_sphere(kLevels);
  RandomStream random(20'000, 0);
  for (Eigen::Vector3d& v : mesh.vertices_mm) {
    const auto [x, y, r2] = random.disc();
    const Eigen::Vector3d side = v.unitOrthogonal();
    v = (v + kJitter * edge * (x * side + y * v.cross(side))).normalized();
  }
  for (Eigen::Vector3d& v : mesh.vertices_mm) {
    double radius = 1.0;
    for (const Bump& b : bumps()) {
      radius += b.height * std::exp(b.narrowness * (v.dot(b.towards.normalized()) - 1.0));
    }
    v *= radius;
  }
  const double scale = 20.0 / bounds(mesh).size_mm().maxCoeff();
  for (Eigen::Vector3d& v : mesh.vertices_mm) v *= scale;
  set_down(mesh);
  return mesh;
}

}  // namespace scattermeter
