// Exit sites: regions of the surface where observed light leaves the object.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include <Eigen/Core>

#include "core/mesh/patch_mesh.h"

namespace scattermeter {

// A patch, or the samples on it (of which the mean is observed), or a single point (covariance 0).
struct ExitSite {
  static constexpr int kMaxPoints = 12;
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_mm2 = Eigen::Matrix3d::Zero();  // rank at most 2
  // Quadrature points with this mean and covariance; weights add up to 1.
  int n_points = 1;
  std::array<Eigen::Vector3d, kMaxPoints> points_mm;
  std::array<double, kMaxPoints> weights{};
  // Fewer points with this mean and covariance, all of the same weight.
  int n_few = 1;
  std::array<Eigen::Vector3d, 3> few_mm;
  double radius_mm() const { return std::sqrt(2.0 * covariance_mm2.trace()); }
};

// The whole patch, sampled evenly: Cowper's six points, exact for polynomials of degree 4.
ExitSite exit_patch(const PatchMesh& patches, int patch_idx);

// Samples on a patch, or on a part of it.
struct SampleSpread {
  double share = 0;  // of all samples on the patch
  Eigen::Vector3d mean_mm = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_mm2 = Eigen::Matrix3d::Zero();
};

// The samples on a patch: the patch's six points under the smallest affine change that gives them
// the samples' mean and covariance, so that the mean of any quadratic over the samples is exact,
// and that of higher degrees nearly so if the samples fill the patch. If they do not,
// `of_quarters`, those of each of its quarters() or none, has each quarter represented by three
// points: light falls off steeply beside the edges that cut the samples off. A covariance of rank
// below 2 is taken as a single point.
ExitSite exit_samples(const PatchMesh& patches, int patch_idx, const SampleSpread& all,
                      std::span<const SampleSpread> of_quarters = {});
inline ExitSite exit_point(const Eigen::Vector3d& p_mm) {
  ExitSite site;
  site.center_mm = site.points_mm[0] = p_mm;
  site.weights[0] = 1.0;
  site.few_mm[0] = p_mm;
  return site;
}
// The same site elsewhere.
ExitSite moved(const ExitSite& site, const Eigen::Vector3d& by_mm);

}  // namespace scattermeter
