// Exit sites: regions of the surface where observed light leaves the object.
#pragma once

#include <array>
#include <cmath>

#include <Eigen/Core>

#include "core/mesh/patch_mesh.h"

namespace scattermeter {

// A patch, or the samples on it (of which the mean is observed), or a single point (covariance 0).
struct ExitSite {
  static constexpr int kMaxPoints = 10;
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
// Shares of a triangle's lattice of ten points, (i, j, k) / 3 in barycentric weights, in a point of
// it: any cubic's value there is that of the points times their shares.
using LatticeShares = std::array<double, 10>;
LatticeShares lattice_shares(const Eigen::Vector3d& barycentric);

// The samples on a patch, given by their mean and covariance: the patch's six points under the
// smallest affine change that gives them this mean and covariance, so that the mean of any
// quadratic over the samples is exact, and that of higher degrees nearly so if the samples fill the
// patch. If they do not, `shares`, the mean of their lattice shares, makes the mean of any cubic
// exact. A covariance of rank below 2 is taken as a single point.
ExitSite exit_samples(const PatchMesh& patches, int patch_idx, const Eigen::Vector3d& mean_mm,
                      const Eigen::Matrix3d& covariance_mm2, const LatticeShares* shares = nullptr);
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
