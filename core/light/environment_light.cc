#include "core/light/environment_light.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include <Eigen/Geometry>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include "core/light/lit_layer.h"
#include "core/light/probe_irradiance.h"
#include "core/mesh/triangle_parts.h"

namespace scattermeter {
namespace {

using Part = ProbeIrradiance::Part;
// Interpolation may err by this many tolerances, at a shadow edge of bright pixels by more: the
// error changes sign along the edge.
constexpr double kSmooth = 3.0;
constexpr double kEdged = 10.0;

// Of the patch size: how far from a facet's border its points are kept.
constexpr double kInset = 0.002;

// Patches of one facet, at most so many: the unit of work.
constexpr int kPatchesAtOnce = 256;
struct Chunk {
  int begin;
  int end;
};

std::vector<Chunk> chunks_of(const PatchMesh& patches) {
  std::vector<Chunk> chunks;
  for (int k = 0; k < patches.size(); ++k) {
    if (chunks.empty() || patches.facet_idx(k) != patches.facet_idx(k - 1) ||
        k - chunks.back().begin == kPatchesAtOnce) {
      chunks.push_back({k, k});
    }
    chunks.back().end = k + 1;
  }
  return chunks;
}

struct ChunkLight {
  std::vector<LitTriangleRgb> lit;
  int shadow_edge_patches = 0;
  std::size_t rays = 0;
};

// A facet of the mesh, and points on it away from its border: at a fold, a point on the border sees
// both sides of the neighbouring facet.
class FacetInset {
 public:
  FacetInset(const Triangle& corners_mm, double inset_mm) : corners_(corners_mm) {
    center_ = (corners_[0] + corners_[1] + corners_[2]) / 3.0;
    const Eigen::Vector3d normal =
        (corners_[1] - corners_[0]).cross(corners_[2] - corners_[0]).normalized();
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
      inward_[i] = normal.cross(corners_[(i + 1) % 3] - corners_[i]).normalized();
      center_distance_[i] = inward_[i].dot(center_ - corners_[i]);
      nearest = std::min(nearest, center_distance_[i]);
    }
    inset_ = std::min(inset_mm, 0.1 * nearest);
  }
  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const {
    double t = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double distance = inward_[i].dot(p - corners_[i]);
      if (distance < inset_) {
        t = std::max(t, (inset_ - distance) / (center_distance_[i] - distance));
      }
    }
    return p + t * (center_ - p);
  }

 private:
  Triangle corners_;
  Eigen::Vector3d center_;
  std::array<Eigen::Vector3d, 3> inward_;
  std::array<double, 3> center_distance_{};
  double inset_;
};

class Illuminator {
 public:
  Illuminator(const PatchMesh& patches, const RayScene& scene, double size_mm,
              ProbeIrradiance& probe, const EnvironmentLightOptions& options)
      : patches_(patches),
        mesh_(scene.mesh()),
        is_convex_(scene.convex()),
        size_mm_(size_mm),
        probe_(probe),
        options_(options) {}

  ChunkLight light(const Chunk& chunk) {
    ChunkLight out;
    const std::size_t rays = probe_.rays();
    const int facet = patches_.facet_idx(chunk.begin);
    const Eigen::Vector3d& normal = patches_.facet_normal(facet);
    const auto& corner = mesh_.triangles[static_cast<std::size_t>(facet)];
    const Triangle corners = {mesh_.vertices_mm[static_cast<std::size_t>(corner[0])],
                              mesh_.vertices_mm[static_cast<std::size_t>(corner[1])],
                              mesh_.vertices_mm[static_cast<std::size_t>(corner[2])]};
    std::vector<Eigen::Vector3d> in_front = in_front_of(corners[0], normal);
    const bool open = in_front.empty();
    probe_.set_facet(normal, std::move(in_front));
    const Eigen::Array3d level = probe_.open(Part::kSky) + probe_.open(Part::kBright);
    for (int k = chunk.begin; k < chunk.end && open; ++k) {
      out.lit.push_back({patches_.corners_mm(k), {level, level, level}, k});
    }
    if (open) return out;
    const FacetInset inset(corners, kInset * patches_.patch_size_mm());
    const PointIrradiance sky = [&](const Eigen::Vector3d& p) {
      return probe_.at(inset(p), Part::kSky);
    };
    const PointIrradiance bright = [&](const Eigen::Vector3d& p) {
      return probe_.at(inset(p), Part::kBright);
    };
    std::map<int, Eigen::Array3d> sky_at;  // by vertex
    for (int k = chunk.begin; k < chunk.end; ++k) {
      LitTriangleRgb patch{patches_.corners_mm(k), {}, k};
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [it, is_new] =
            sky_at.try_emplace(patches_.vertex_idx(k)[i], Eigen::Array3d::Zero());
        if (is_new) it->second = sky(patch.corners_mm[i]);
        patch.irradiance[i] = it->second;
      }
      const std::size_t first = out.lit.size();
      append_smooth(patch, sky, kSmooth * options_.tolerance * level, level,
                    options_.sky_bisections, out.lit);
      add_bright(k, bright, level, first, out);
    }
    out.rays = probe_.rays() - rays;
    return out;
  }

 private:
  std::vector<Eigen::Vector3d> in_front_of(const Eigen::Vector3d& on_plane,
                                           const Eigen::Vector3d& normal) const {
    if (is_convex_) return {};
    // Points this little in front of the plane are on it, up to rounding.
    const double least_mm = 1e-7 * size_mm_;
    std::vector<Eigen::Vector3d> found;
    for (const Eigen::Vector3d& v : mesh_.vertices_mm) {
      if (normal.dot(v - on_plane) > least_mm) found.push_back(v);
    }
    return found;
  }

  // `first`: where the sky's triangles of the patch begin.
  void add_bright(int k, const PointIrradiance& bright, const Eigen::Array3d& level,
                  std::size_t first, ChunkLight& out) const {
    if ((probe_.open(Part::kBright) == 0.0).all()) return;
    const Triangle t = patches_.corners_mm(k);
    const Eigen::Vector3d center = (t[0] + t[1] + t[2]) / 3.0;
    LitTriangleRgb patch{t, {bright(t[0]), bright(t[1]), bright(t[2])}, k};
    Eigen::Array3d low = patch.irradiance[0].min(patch.irradiance[1]).min(patch.irradiance[2]);
    Eigen::Array3d high = patch.irradiance[0].max(patch.irradiance[1]).max(patch.irradiance[2]);
    for (const Eigen::Vector3d& p : {center, (0.5 * (t[0] + t[1])).eval(),
                                     (0.5 * (t[1] + t[2])).eval(), (0.5 * (t[2] + t[0])).eval()}) {
      const Eigen::Array3d e = bright(p);
      low = low.min(e);
      high = high.max(e);
    }
    const Eigen::Array3d allowed = kEdged * options_.tolerance * level;
    if ((high - low <= allowed).all()) {
      if ((high == 0.0).all()) return;
      if (out.lit.size() == first + 1) {
        for (std::size_t i = 0; i < 3; ++i) out.lit[first].irradiance[i] += patch.irradiance[i];
      } else {
        out.lit.push_back(patch);
      }
      return;
    }
    ++out.shadow_edge_patches;
    append_edged(patch, bright, allowed, options_.shadow_bisections, out.lit);
  }

  const PatchMesh& patches_;
  const TriangleMesh& mesh_;
  bool is_convex_;
  double size_mm_;  // of the mesh
  ProbeIrradiance& probe_;
  const EnvironmentLightOptions& options_;
};

}  // namespace

std::array<IncidentLight, 3> illuminate(const PatchMesh& patches, const RayScene& scene,
                                        const ProbeTree& probe, double eta_int_over_ext,
                                        const EnvironmentLightOptions& options) {
  const TransmittedCosine transmitted(eta_int_over_ext);
  tbb::enumerable_thread_specific<ProbeIrradiance> workspace(
      [&] { return ProbeIrradiance(probe, &scene, transmitted, options.tolerance); });
  const std::vector<Chunk> chunks = chunks_of(patches);
  std::vector<ChunkLight> parts(chunks.size());
  const double size_mm = scene.size_mm();
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t i) {
    parts[i] = Illuminator(patches, scene, size_mm, workspace.local(), options).light(chunks[i]);
  });
  std::vector<LitTriangleRgb> lit;
  int edges = 0;
  std::size_t rays = 0;
  for (const ChunkLight& part : parts) {
    lit.insert(lit.end(), part.lit.begin(), part.lit.end());
    edges += part.shadow_edge_patches;
    rays += part.rays;
  }
  std::array<IncidentLight, 3> light;
  for (int c = 0; c < 3; ++c) {
    IncidentLight& one = light[static_cast<std::size_t>(c)];
    one = channel_light(lit, c, patches.size());
    one.shadow_edge_patches = edges;
    one.shadow_rays = rays;
  }
  return light;
}

Eigen::Array3d open_irradiance(const ProbeTree& probe, const Eigen::Vector3d& normal,
                               double eta_int_over_ext, double tolerance) {
  const TransmittedCosine transmitted(eta_int_over_ext);
  ProbeIrradiance irradiance(probe, nullptr, transmitted, tolerance);
  irradiance.set_facet(normal, {});
  return irradiance.open(Part::kSky) + irradiance.open(Part::kBright);
}

}  // namespace scattermeter
