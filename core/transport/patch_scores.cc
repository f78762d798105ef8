#include "core/transport/patch_scores.h"

#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

namespace scattermeter {
namespace {

struct Tally {
  const PatchMesh* patches;
  const TriangleMesh* mesh;
  std::vector<Eigen::Vector3d> sum;
  void escape(const PathScore&) {}
  void camera(const PathScore& s) {
    sum[static_cast<std::size_t>(patch_of(*patches, *mesh, s.facet_idx, s.point_mm).patch_idx)] +=
        s.weight * Eigen::Vector3d(1.0, s.scatterings, s.length_mm);
  }
};

}  // namespace

PatchPoint patch_of(const PatchMesh& patches, const TriangleMesh& mesh, int facet_idx,
                    const Eigen::Vector3d& point_mm) {
  const auto& t = mesh.triangles[static_cast<std::size_t>(facet_idx)];
  const Eigen::Vector3d& a = mesh.vertices_mm[static_cast<std::size_t>(t[0])];
  const Eigen::Vector3d ab = mesh.vertices_mm[static_cast<std::size_t>(t[1])] - a;
  const Eigen::Vector3d ac = mesh.vertices_mm[static_cast<std::size_t>(t[2])] - a;
  const Eigen::Vector3d ap = point_mm - a;
  const Eigen::Vector3d normal = ab.cross(ac);
  const double v = normal.dot(ap.cross(ac)) / normal.squaredNorm();
  const double w = normal.dot(ab.cross(ap)) / normal.squaredNorm();
  return patches.locate(facet_idx, {1.0 - v - w, v, w});
}

PatchScores patch_scores(const PatchMesh& patches, const PathWorld& world,
                         const PathOptions& options, int first, int end) {
  if (end - first < 2 || world.camera == nullptr) {
    throw std::invalid_argument("patch_scores: blocks " + std::to_string(first) + " to " +
                                std::to_string(end) + ", or no camera");
  }
  const auto n = static_cast<std::size_t>(patches.size());
  PatchScores out;
  out.mean.assign(n, Eigen::Vector3d::Zero());
  out.covariance.assign(n, Eigen::Matrix3d::Zero());
  trace_blocks<Tally>(
      world, options, first, end,
      [&] {
        return Tally{&patches, &world.boundary.scene().mesh(),
                     std::vector<Eigen::Vector3d>(n, Eigen::Vector3d::Zero())};
      },
      [&](const Tally& tally, const PathAudit& audit) {
        // Welford's update.
        ++out.blocks;
        for (std::size_t k = 0; k < n; ++k) {
          const Eigen::Vector3d before = tally.sum[k] - out.mean[k];
          out.mean[k] += before / out.blocks;
          out.covariance[k] += before * (tally.sum[k] - out.mean[k]).transpose();
        }
        out.audit += audit;
      });
  for (Eigen::Matrix3d& c : out.covariance) {
    c = (0.5 * (c + c.transpose()) / (static_cast<double>(out.blocks) * (out.blocks - 1))).eval();
  }
  for (double* power : {&out.audit.entered, &out.audit.absorbed, &out.audit.in_plane,
                        &out.audit.escaped, &out.audit.roulette, &out.audit.lost}) {
    *power /= out.blocks;
  }
  return out;
}

}  // namespace scattermeter
