// Sums over pairs of exit and entry points, sorted by distance.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/distance_bins.h"
#include "core/incident_light.h"
#include "core/patch_mesh.h"

namespace scattermeter {

// Where light leaves: a whole patch (its mean counts) or a single point (size 0).
struct ExitSite {
  Eigen::Vector3d center_mm;
  std::array<Eigen::Vector3d, 3> points_mm;  // equal weights, exact for polynomials of degree 2
  double size_mm = 0;                        // longest edge of the patch; 0: only center_mm counts
};

// The whole patch, sampled evenly.
ExitSite exit_patch(const PatchMesh& patches, int patch_idx);
// The samples that fell on a patch: three points with their mean and covariance (of rank 2), so
// that the mean of any quadratic over the samples is exact. `size_mm`: longest edge of the patch.
ExitSite exit_samples(const Eigen::Vector3d& mean_mm, const Eigen::Matrix3d& covariance_mm2,
                      double size_mm);
inline ExitSite exit_point(const Eigen::Vector3d& p_mm) { return {p_mm, {p_mm, p_mm, p_mm}, 0.0}; }

struct PairSumOptions {
  // One pair of centres stands for site and source where they are farther apart than this many
  // times the longer of their edges. Nearer ones are integrated: three points on the site's side,
  // and on the source's side three points of triangles cut until they are smaller than distance /
  // near_ratio or than floor_mm. Measured on a plane with R at z_r = size: see
  // tests/core/pair_sums_test.cc.
  double far_ratio = 10.0;
  double near_ratio = 3.0;
  double floor_mm = 0.02;
};

// The lit surface, ready for summing: a flat copy in single precision, relative to `origin_mm`.
class SourceCloud {
 public:
  SourceCloud(const IncidentLight& light, const Eigen::Vector3d& origin_mm);

  std::size_t size() const { return power_.size(); }
  // Adds, for the mean over the site, the entering power of every source at its distance:
  // afterwards sum over i of sums[i] f(d_i) is the mean over the site of
  // ∫ E(x) f(|x_site - x|) dA, for any f that the bins represent. sums: bins.size() values, in sr.
  template <class Bins>
  void add_to(const ExitSite& site, const Bins& bins, const PairSumOptions& options,
              double* sums) const;

 private:
  Eigen::Vector3d origin_mm_;
  std::vector<float> x_, y_, z_;  // centroid of the entering power
  std::vector<float> power_;      // sr
  std::vector<float> edge_;       // longest edge, mm
  std::vector<LitTriangle> triangles_;
};

}  // namespace scattermeter
