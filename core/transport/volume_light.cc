#include "core/transport/volume_light.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include <Eigen/SparseCholesky>

#include "core/base/disjoint_sets.h"
#include "core/base/median.h"
#include "core/transport/patch_scores.h"

namespace scattermeter {
namespace {

constexpr int kBlocks = 64;
constexpr double kSmoothCosine = 0.94;  // of 20 degrees

struct FieldTally {
  const SurfaceField* field;
  const PatchMesh* patches;
  const TriangleMesh* mesh;
  Eigen::VectorXd at_node;  // scores times the nodes' functions
  Eigen::ArrayXd on_patch;
  template <class F>
  void numbers(const F& f) {
    for (double& score : at_node) f(score);
    for (double& score : on_patch) f(score);
  }
  void escape(const PathScore&) {}
  void camera(const PathScore& s) {
    const PatchPoint at = patch_of(*patches, *mesh, s.facet_idx, s.point_mm);
    const auto& node = field->nodes_of(at.patch_idx);
    if (node[0] < 0) return;
    for (int i = 0; i < 3; ++i) {
      at_node[node[static_cast<std::size_t>(i)]] += s.weight * at.barycentric[i];
    }
    on_patch[at.patch_idx] += s.weight;
  }
};

// Integrals of products of the nodes' functions: area/12, area/6 on the diagonal. Nodes that are no
// corner get a one, so that they stay zero.
Eigen::SparseMatrix<double> products(const SurfaceField& field, const PatchMesh& patches) {
  const auto n = static_cast<Eigen::Index>(field.nodes_mm().size());
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<bool> corner(static_cast<std::size_t>(n), false);
  for (int k = 0; k < patches.size(); ++k) {
    const auto& node = field.nodes_of(k);
    if (node[0] < 0) continue;
    const double area = patches.area_mm2(k);
    for (std::size_t i = 0; i < 3; ++i) {
      corner[static_cast<std::size_t>(node[i])] = true;
      for (std::size_t j = 0; j < 3; ++j) {
        entries.emplace_back(node[i], node[j], i == j ? area / 6.0 : area / 12.0);
      }
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!corner[static_cast<std::size_t>(i)]) entries.emplace_back(i, i, 1.0);
  }
  Eigen::SparseMatrix<double> m(n, n);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

}  // namespace

VolumeLight volume_radiosity(const SurfaceField& field, const PatchMesh& patches,
                             const PathWorld& world, const VolumeLightOptions& options) {
  if (options.paths < 1 || world.camera == nullptr) {
    throw std::invalid_argument("volume_radiosity: paths = " + std::to_string(options.paths) +
                                ", or no camera");
  }
  PathOptions path_options;
  path_options.seed = options.seed;
  path_options.isotropic_beyond = kIsotropicBeyond;
  path_options.paths_per_block = static_cast<int>((options.paths + kBlocks - 1) / kBlocks);
  path_options.peers = options.peers;
  const auto n_nodes = static_cast<Eigen::Index>(field.nodes_mm().size());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(n_nodes);
  Eigen::ArrayXd mean = Eigen::ArrayXd::Zero(patches.size());
  Eigen::ArrayXd square = mean;
  VolumeLight out;
  trace_blocks<FieldTally>(
      world, path_options, 0, kBlocks,
      [&] {
        return FieldTally{&field, &patches, &world.boundary.scene().mesh(),
                          Eigen::VectorXd::Zero(n_nodes), Eigen::ArrayXd::Zero(patches.size())};
      },
      [&](const FieldTally& tally, const PathAudit& audit) {
        sum += tally.at_node / kBlocks;
        mean += tally.on_patch / kBlocks;
        square += tally.on_patch.square() / kBlocks;
        out.audit += audit;
      });
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(products(field, patches));
  const Eigen::VectorXd l = solver.solve(sum);
  out.l_at_nodes.assign(l.data(), l.data() + l.size());
  std::vector<double> relative;
  for (int k = 0; k < patches.size(); ++k) {
    const auto& node = field.nodes_of(k);
    if (node[0] < 0) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      out.l_at_nodes[static_cast<std::size_t>(node[i + 3])] =
          0.5 * (l[node[i]] + l[node[(i + 1) % 3]]);
    }
    if (mean[k] > 0.0) {
      relative.push_back(std::sqrt((square[k] - mean[k] * mean[k]) / (kBlocks - 1)) / mean[k]);
    }
  }
  if (!relative.empty()) {
    out.median_relative_std = upper_median(std::move(relative));
  }
  return out;
}

std::vector<int> smooth_parts(const TriangleMesh& mesh) {
  DisjointSets parts(mesh.triangles.size());
  std::map<std::pair<int, int>, int> facet_at;
  for (int f = 0; f < static_cast<int>(mesh.triangles.size()); ++f) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(f)];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [it, is_new] = facet_at.try_emplace(std::minmax(t[i], t[(i + 1) % 3]), f);
      if (is_new) continue;
      const Eigen::Vector3d a = area_vector_mm2(mesh, f);
      const Eigen::Vector3d b = area_vector_mm2(mesh, it->second);
      if (a.dot(b) < kSmoothCosine * a.norm() * b.norm()) continue;
      parts.join(f, it->second);
    }
  }
  std::vector<int> part_of_facet;
  for (int f = 0; f < static_cast<int>(mesh.triangles.size()); ++f) {
    part_of_facet.push_back(parts.set_of(f));
  }
  return part_of_facet;
}

double volume_patch_size_mm(double mean_free_path_mm, double object_size_mm) {
  return std::clamp(0.8 * mean_free_path_mm, object_size_mm / 125.0, object_size_mm / 40.0);
}

}  // namespace scattermeter
