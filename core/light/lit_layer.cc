#include "core/light/lit_layer.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "core/mesh/triangle_parts.h"

namespace scattermeter {
namespace {

// The two halves of a triangle, cut from `apex` to the middle of the opposite edge.
std::array<LitTriangleRgb, 2> halves(const LitTriangleRgb& t, std::size_t apex,
                                     const Eigen::Vector3d& middle, const Eigen::Array3d& value) {
  const std::size_t b = (apex + 1) % 3;
  const std::size_t c = (apex + 2) % 3;
  return {{{{t.corners_mm[apex], t.corners_mm[b], middle},
            {t.irradiance[apex], t.irradiance[b], value},
            t.patch_idx},
           {{t.corners_mm[apex], middle, t.corners_mm[c]},
            {t.irradiance[apex], value, t.irradiance[c]},
            t.patch_idx}}};
}

Eigen::Array3d mean_of(const std::array<Eigen::Array3d, 3>& v) {
  return (v[0] + v[1] + v[2]) / 3.0;
}

// Mean over the centres of 16 equal parts.
Eigen::Array3d mean_over(const std::array<Eigen::Vector3d, 3>& t,
                         const PointIrradiance& irradiance) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  int parts = 0;
  for_16_parts(t, [&](const Eigen::Vector3d& p) {
    sum += irradiance(p);
    ++parts;
  });
  return sum / parts;
}

void split_edged(const LitTriangleRgb& t, const PointIrradiance& irradiance,
                 const Eigen::Array3d& allowed, int cuts, int bisections,
                 std::vector<LitTriangleRgb>& out) {
  const auto& p = t.corners_mm;
  const auto& e = t.irradiance;
  const std::size_t apex = apex_of_longest_edge(p);
  const std::size_t b = (apex + 1) % 3;
  const std::size_t c = (apex + 2) % 3;
  const Eigen::Vector3d middle = 0.5 * (p[b] + p[c]);
  const Eigen::Array3d at_middle = irradiance(middle);
  if (cuts >= std::min(2, bisections)) {
    const Eigen::Array3d at_center = irradiance((p[0] + p[1] + p[2]) / 3.0);
    if (((at_middle - 0.5 * (e[b] + e[c])).abs() <= allowed).all() &&
        ((at_center - mean_of(e)).abs() <= allowed).all()) {
      out.push_back(t);
      return;
    }
    if (cuts >= bisections) {
      const Eigen::Array3d mean = mean_over(p, irradiance);
      out.push_back({p, {mean, mean, mean}, t.patch_idx});
      return;
    }
  }
  for (const LitTriangleRgb& half : halves(t, apex, middle, at_middle)) {
    split_edged(half, irradiance, allowed, cuts + 1, bisections, out);
  }
}

}  // namespace

void append_smooth(const LitTriangleRgb& patch, const PointIrradiance& irradiance,
                   const Eigen::Array3d& allowed, const Eigen::Array3d& level, int bisections,
                   std::vector<LitTriangleRgb>& out) {
  const auto& e = patch.irradiance;
  const Eigen::Array3d difference = e[0].max(e[1]).max(e[2]) - e[0].min(e[1]).min(e[2]);
  if (bisections == 0 || (difference.square() <= 8.0 * allowed * level).all()) {
    out.push_back(patch);
    return;
  }
  const std::size_t apex = apex_of_longest_edge(patch.corners_mm);
  const std::size_t b = (apex + 1) % 3;
  const std::size_t c = (apex + 2) % 3;
  const Eigen::Vector3d middle = 0.5 * (patch.corners_mm[b] + patch.corners_mm[c]);
  const Eigen::Array3d at_middle = irradiance(middle);
  if (((at_middle - 0.5 * (e[b] + e[c])).abs() <= allowed).all()) {
    const Eigen::Array3d at_center =
        irradiance((patch.corners_mm[0] + patch.corners_mm[1] + patch.corners_mm[2]) / 3.0);
    if (((at_center - mean_of(e)).abs() <= allowed).all()) {
      out.push_back(patch);
      return;
    }
  }
  for (const LitTriangleRgb& half : halves(patch, apex, middle, at_middle)) {
    append_smooth(half, irradiance, allowed, level, bisections - 1, out);
  }
}

void append_edged(const LitTriangleRgb& patch, const PointIrradiance& irradiance,
                  const Eigen::Array3d& allowed, int bisections, std::vector<LitTriangleRgb>& out) {
  split_edged(patch, irradiance, allowed, 0, bisections, out);
}

IncidentLight channel_light(const std::vector<LitTriangleRgb>& triangles, int channel,
                            int patches) {
  IncidentLight light;
  light.patch_power_sr.assign(static_cast<std::size_t>(patches), 0.0);
  for (const LitTriangleRgb& t : triangles) {
    LitTriangle lit{t.corners_mm, {}, t.patch_idx};
    for (std::size_t i = 0; i < 3; ++i) lit.irradiance_sr_per_mm2[i] = t.irradiance[i][channel];
    const double power = power_sr(lit);
    if (!(power > 0.0)) continue;
    light.patch_power_sr[static_cast<std::size_t>(t.patch_idx)] += power;
    light.lit.push_back(lit);
  }
  return light;
}

}  // namespace scattermeter
