#include "core/light/lit_points.h"

#include <array>
#include <cmath>
#include <span>

#include "core/mesh/triangle_parts.h"

namespace scattermeter {
namespace {

// Longest edge over the scale up to which the three-point rule is as good as the six-point rule is
// at 1 (measured on cubes and pyramids: both 5e-5 of the dipole's sum at worst).
constexpr double kThreePointEdge = 0.6;

struct Rule {
  std::span<const TriangleOrbit> orbits;
  int cuts;  // parts along each edge

  std::size_t points() const { return 3 * orbits.size() * static_cast<std::size_t>(cuts * cuts); }
};

Rule rule_for(double edge_over_scale) {
  if (edge_over_scale <= kThreePointEdge) return {kThreePoints, 1};
  return {kCowper, static_cast<int>(std::ceil(edge_over_scale))};
}

void append_points(const LitTriangle& triangle, const Rule& rule, LitPoints& out) {
  using Barycentric = Eigen::Vector3d;
  const Eigen::Map<const Eigen::Vector3d> irradiance(triangle.irradiance_sr_per_mm2.data());
  const double part_mm2 = area_mm2(triangle.corners_mm) / (rule.cuts * rule.cuts);
  const auto append_part = [&](const std::array<Barycentric, 3>& corners) {
    for (const TriangleOrbit& orbit : rule.orbits) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Barycentric at =
            orbit.a * corners[i] + orbit.b() * (corners[(i + 1) % 3] + corners[(i + 2) % 3]);
        out.points_mm.push_back(at[0] * triangle.corners_mm[0] + at[1] * triangle.corners_mm[1] +
                                at[2] * triangle.corners_mm[2]);
        out.power_sr.push_back(orbit.weight * part_mm2 * at.dot(irradiance));
      }
    }
  };
  const auto lattice = [&](int i, int j) -> Barycentric {
    return Barycentric(rule.cuts - i - j, i, j) / rule.cuts;
  };
  for (int i = 0; i < rule.cuts; ++i) {
    for (int j = 0; j < rule.cuts - i; ++j) {
      // The upright part (i, j), and the inverted one beside it where there is one.
      append_part({lattice(i, j), lattice(i + 1, j), lattice(i, j + 1)});
      if (i + j + 1 < rule.cuts) {
        append_part({lattice(i + 1, j + 1), lattice(i, j + 1), lattice(i + 1, j)});
      }
    }
  }
}

}  // namespace

std::optional<LitPoints> lit_points(const IncidentLight& light, double scale_mm,
                                    std::size_t most_points) {
  std::size_t count = 0;
  std::vector<Rule> rules;
  rules.reserve(light.lit.size());
  for (const LitTriangle& triangle : light.lit) {
    const double edge_over_scale = longest_edge_mm(triangle.corners_mm) / scale_mm;
    // Below this the number of parts is far within int.
    if (!(edge_over_scale * edge_over_scale <= static_cast<double>(most_points))) return {};
    rules.push_back(rule_for(edge_over_scale));
    count += rules.back().points();
    if (count > most_points) return {};
  }
  LitPoints out;
  out.points_mm.reserve(count);
  out.power_sr.reserve(count);
  for (std::size_t i = 0; i < rules.size(); ++i) append_points(light.lit[i], rules[i], out);
  return out;
}

}  // namespace scattermeter
