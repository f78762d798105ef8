// Triangles: centroid, area, longest edge, equal parts and quadrature rules.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace scattermeter {

using Triangle = std::array<Eigen::Vector3d, 3>;

inline Eigen::Vector3d middle_mm(const Triangle& t) { return (t[0] + t[1] + t[2]) / 3.0; }

inline double area_mm2(const Triangle& t) { return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm(); }

inline double longest_edge_mm(const Triangle& t) {
  return std::sqrt(std::max(
      {(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(), (t[0] - t[2]).squaredNorm()}));
}

// Corner opposite the longest edge; the first of equals.
inline std::size_t apex_of_longest_edge(const Triangle& t) {
  std::size_t apex = 0;
  double longest = -1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = (t[(i + 2) % 3] - t[(i + 1) % 3]).squaredNorm();
    if (length > longest) {
      longest = length;
      apex = i;
    }
  }
  return apex;
}

// Calls `visit` with the centres of 16 equal parts.
template <class Visit>
void for_16_parts(const Triangle& t, const Visit& visit) {
  constexpr int kRows = 4;
  const auto at = [&](double u, double v) -> Eigen::Vector3d {
    return t[0] + u / kRows * (t[1] - t[0]) + v / kRows * (t[2] - t[0]);
  };
  for (int i = 0; i < kRows; ++i) {
    for (int j = 0; j < kRows - i; ++j) {
      // Upright part (i, j), and the inverted one beside it where there is one.
      visit(at(i + 1.0 / 3.0, j + 1.0 / 3.0));
      if (i + j + 1 < kRows) visit(at(i + 2.0 / 3.0, j + 2.0 / 3.0));
    }
  }
}

// The four equal parts: those at the corners, in their order, and the middle one.
inline std::array<Triangle, 4> quarters(const Triangle& t) {
  const Eigen::Vector3d a = 0.5 * (t[1] + t[2]), b = 0.5 * (t[2] + t[0]), c = 0.5 * (t[0] + t[1]);
  return {{{t[0], c, b}, {c, t[1], a}, {b, a, t[2]}, {a, b, c}}};
}
// The quarter in which a point of the triangle's plane lies.
inline std::size_t quarter_of(const Triangle& t, const Eigen::Vector3d& p) {
  const Eigen::Vector3d b = t[1] - t[0], c = t[2] - t[0], r = p - t[0];
  const double bb = b.dot(b), bc = b.dot(c), cc = c.dot(c);
  const double det = bb * cc - bc * bc;
  const double v = (cc * r.dot(b) - bc * r.dot(c)) / det;
  const double w = (bb * r.dot(c) - bc * r.dot(b)) / det;
  return v + w < 0.5 ? 0 : v > 0.5 ? 1 : w > 0.5 ? 2 : 3;
}

// Cowper's six-point rule of degree 4: two orbits of points with barycentric weights (a, b, b) and
// their rotations.
struct TriangleOrbit {
  double a;
  double weight;  // of each point; the six add up to 1
  constexpr double b() const { return 0.5 * (1.0 - a); }
};
inline constexpr std::array<TriangleOrbit, 2> kCowper = {
    {{0.108103018168070, 0.223381589678011}, {0.816847572980459, 0.109951743655322}}};

// The three-point rule of degree 2.
inline constexpr std::array<TriangleOrbit, 1> kThreePoints = {{{2.0 / 3.0, 1.0 / 3.0}}};

}  // namespace scattermeter
