#include "core/light/incident_light.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include <Eigen/Geometry>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "core/light/disc_light.h"
#include "core/light/lit_layer.h"
#include "core/mesh/triangle_parts.h"

namespace scattermeter {
namespace {

// Relative to the full irradiance: the error of linear interpolation on each part of a penumbra.
constexpr double kHalfShadowError = 1e-3;

// For a disc, the points of a patch are moved towards its centre by this share, away from folds.
constexpr double kDrawn = 0.002;

// The light of a small source is convex over a patch, so a linear density overestimates it.
// Corners (1/12 each) and centre (3/4) give the power exactly to second order; the factor that
// scales the density of these corners to that. `sum`: of the irradiance at the corners, > 0.
double power_share(double center, double sum) { return 0.25 + 2.25 * center / sum; }

struct PatchLight {
  std::vector<LitTriangle> lit;
  bool on_shadow_edge = false;
  std::size_t rays = 0;
  std::size_t rays_skipped = 0;
};

class Illuminator {
 public:
  Illuminator(const PatchMesh& patches, const RayScene& scene, const Led& led, double eta,
              const IncidentLightOptions& options)
      : patches_(patches), scene_(scene), led_(led), eta_(eta), options_(options) {
    if (led.radius_mm > 0.0) disc_.emplace(led, scene, eta);
  }

  PatchLight patch(int k) const {
    PatchLight out;
    const Triangle t = patches_.corners_mm(k);
    const Eigen::Vector3d& n = patches_.normal(k);
    if (disc_) return disc_patch(k, t, n);
    if (!faces_led(k, t)) return out;
    // Probes at corners and edge midpoints are moved slightly towards the centre, so that a fold of
    // the surface at the patch's own border does not count as a shadow.
    if (on_convex_body(k, t[0], n)) {
      out.rays_skipped = 7;
      append(t, k, 1.0, out);
      return out;
    }
    const Eigen::Vector3d center = (t[0] + t[1] + t[2]) / 3.0;
    int lit = 0;
    int probes = 0;
    const auto probe = [&](const Eigen::Vector3d& p) {
      lit += is_lit(p + 0.02 * (center - p), n, out) ? 1 : 0;
      ++probes;
    };
    for (int i = 0; i < 3; ++i) {
      probe(t[i]);
      probe(0.5 * (t[i] + t[(i + 1) % 3]));
    }
    probe(center);
    if (lit == probes) {
      append(t, k, 1.0, out);
    } else if (lit > 0) {
      out.on_shadow_edge = true;
      split(t, n, k, options_.shadow_bisections, out);
    }
    return out;
  }

 private:
  // Whether the surface turns towards the LED at any corner.
  bool faces_led(int k, const Triangle& t) const {
    return std::any_of(t.begin(), t.end(), [&](const Eigen::Vector3d& corner) {
      return patches_.normal_at(k, corner).dot(led_.position_mm - corner) > 0.0;
    });
  }

  // A disc casts penumbras, in which the irradiance itself varies.
  PatchLight disc_patch(int k, const Triangle& t, const Eigen::Vector3d& n) const {
    PatchLight out;
    LitTriangleRgb patch{t, {}, k};
    double brightest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double e = disc_->open_per_mm2(t[i], patches_.normal_at(k, t[i]));
      patch.irradiance[i].setConstant(e);
      brightest = std::max(brightest, e);
    }
    if (!(brightest > 0.0)) return out;
    const Eigen::Vector3d center = (t[0] + t[1] + t[2]) / 3.0;
    double least = 1.0;
    double most = 0.0;
    const auto probe = [&](const Eigen::Vector3d& p) {
      const double share = disc_->visible_share(p + kDrawn * (center - p), n, out.rays);
      least = std::min(least, share);
      most = std::max(most, share);
      return share;
    };
    for (std::size_t i = 0; i < 3; ++i) {
      patch.irradiance[i] *= probe(t[i]);
      probe(0.5 * (t[i] + t[(i + 1) % 3]));
    }
    probe(center);
    if (most == 0.0) return out;
    std::vector<LitTriangleRgb> lit;
    if (least == 1.0) {
      double sum = 0.0;
      for (const Eigen::Array3d& e : patch.irradiance) sum += e[0];
      for (Eigen::Array3d& e : patch.irradiance) {
        e *= power_share(disc_->open_per_mm2(center, patches_.normal_at(k, center)), sum);
      }
      lit.push_back(patch);
    } else {
      out.on_shadow_edge = true;
      const PointIrradiance irradiance = [&](const Eigen::Vector3d& at) -> Eigen::Array3d {
        const Eigen::Vector3d p = at + kDrawn * (center - at);
        return Eigen::Array3d::Constant(disc_->open_per_mm2(p, patches_.normal_at(k, p)) *
                                        disc_->visible_share(p, n, out.rays));
      };
      append_edged(patch, irradiance, Eigen::Array3d::Constant(kHalfShadowError * brightest),
                   options_.shadow_bisections, lit);
    }
    for (const LitTriangleRgb& part : lit) {
      LitTriangle one{part.corners_mm, {}, k};
      for (std::size_t i = 0; i < 3; ++i) one.irradiance_sr_per_mm2[i] = part.irradiance[i][0];
      out.lit.push_back(one);
    }
    return out;
  }

  // Whether the patch belongs to a facet of the scene's body and that is convex: then all that
  // faces the LED is lit. Patches may be of another mesh than the scene.
  bool on_convex_body(int k, const Eigen::Vector3d& p, const Eigen::Vector3d& n) const {
    if (!scene_.convex()) return false;
    const TriangleMesh& mesh = scene_.mesh();
    const int facet = patches_.facet_idx(k);
    if (static_cast<std::size_t>(facet) >= mesh.triangles.size()) return false;
    const auto& t = mesh.triangles[static_cast<std::size_t>(facet)];
    const Eigen::Vector3d from = p - mesh.vertices_mm[static_cast<std::size_t>(t[0])];
    constexpr double kSame = 1e-9;
    return (area_vector_mm2(mesh, facet).normalized() - n).norm() < kSame &&
           std::abs(n.dot(from)) <= kSame * from.norm();
  }

  bool is_lit(const Eigen::Vector3d& p, const Eigen::Vector3d& n, PatchLight& out) const {
    ++out.rays;
    return !scene_.occluded(p, n, led_.position_mm);
  }

  // `share`: of the triangle that is lit.
  void append(const Triangle& t, int k, double share, PatchLight& out) const {
    const auto irradiance = [&](const Eigen::Vector3d& p) {
      return led_.transmitted_irradiance_per_mm2(p, patches_.normal_at(k, p), eta_);
    };
    LitTriangle lit{t, {}, k};
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      lit.irradiance_sr_per_mm2[i] = irradiance(t[i]);
      sum += lit.irradiance_sr_per_mm2[i];
    }
    if (!(sum > 0.0)) return;
    const double center = irradiance((t[0] + t[1] + t[2]) / 3.0);
    const double scaled = share * power_share(center, sum);
    for (double& e : lit.irradiance_sr_per_mm2) e *= scaled;
    out.lit.push_back(lit);
  }

  // Share of a small triangle that is lit: all or nothing where corners and centre agree, else
  // counted over the centres of 16 equal parts.
  double lit_share(const Triangle& t, const Eigen::Vector3d& n, PatchLight& out) const {
    const Eigen::Vector3d center = (t[0] + t[1] + t[2]) / 3.0;
    int lit = is_lit(center, n, out) ? 1 : 0;
    for (const Eigen::Vector3d& corner : t) {
      lit += is_lit(corner + 0.02 * (center - corner), n, out) ? 1 : 0;
    }
    if (lit == 0 || lit == 4) return lit == 4 ? 1.0 : 0.0;
    lit = 0;
    int parts = 0;
    for_16_parts(t, [&](const Eigen::Vector3d& p) {
      lit += is_lit(p, n, out) ? 1 : 0;
      ++parts;
    });
    return static_cast<double>(lit) / parts;
  }

  // Bisects at the longest edge.
  void split(const Triangle& t, const Eigen::Vector3d& n, int k, int levels,
             PatchLight& out) const {
    if (levels == 0) {
      const double share = lit_share(t, n, out);
      if (share > 0.0) append(t, k, share, out);
      return;
    }
    const std::size_t a = apex_of_longest_edge(t);
    const Eigen::Vector3d& pa = t[a];
    const Eigen::Vector3d& pb = t[(a + 1) % 3];
    const Eigen::Vector3d& pc = t[(a + 2) % 3];
    const Eigen::Vector3d m = 0.5 * (pb + pc);
    split({pa, pb, m}, n, k, levels - 1, out);
    split({pa, m, pc}, n, k, levels - 1, out);
  }

  const PatchMesh& patches_;
  const RayScene& scene_;
  const Led& led_;
  double eta_;
  std::optional<DiscLight> disc_;
  IncidentLightOptions options_;
};

}  // namespace

double power_sr(const LitTriangle& triangle) {
  const double area_mm2 = 0.5 * (triangle.corners_mm[1] - triangle.corners_mm[0])
                                    .cross(triangle.corners_mm[2] - triangle.corners_mm[0])
                                    .norm();
  return area_mm2 *
         (triangle.irradiance_sr_per_mm2[0] + triangle.irradiance_sr_per_mm2[1] +
          triangle.irradiance_sr_per_mm2[2]) /
         3.0;
}

IncidentLight illuminate(const PatchMesh& patches, const RayScene& scene, const Led& led,
                         double eta_int_over_ext, const IncidentLightOptions& options) {
  const Illuminator illuminator(patches, scene, led, eta_int_over_ext, options);
  std::vector<PatchLight> per_patch(static_cast<std::size_t>(patches.size()));
  tbb::parallel_for(tbb::blocked_range<int>(0, patches.size(), 64),
                    [&](const tbb::blocked_range<int>& range) {
                      for (int k = range.begin(); k < range.end(); ++k) {
                        per_patch[static_cast<std::size_t>(k)] = illuminator.patch(k);
                      }
                    });
  IncidentLight light;
  light.patch_power_sr.assign(per_patch.size(), 0.0);
  for (std::size_t k = 0; k < per_patch.size(); ++k) {
    for (const LitTriangle& t : per_patch[k].lit) {
      const double power = power_sr(t);
      if (!(power > 0.0)) continue;
      light.patch_power_sr[k] += power;
      light.lit.push_back(t);
    }
    light.shadow_edge_patches += per_patch[k].on_shadow_edge ? 1 : 0;
    light.shadow_rays += per_patch[k].rays;
    light.shadow_rays_skipped += per_patch[k].rays_skipped;
  }
  return light;
}

}  // namespace scattermeter
