// Exit sites: regions of the surface where observed light leaves the object.
#pragma once

#include <array>
#include <cmath>

#include <Eigen/Core>

#include "core/mesh/patch_mesh.h"

namespace scattermeter {

// A patch, or the samples on it (of which the mean is observed), or a single point (covariance 0).
struct ExitSite {
  static constexpr int kMaxPoints = 6;
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_mm2 = Eigen::Matrix3d::Zero();  // rank at most 2
  // Quadrature points with this mean and covariance; weights add up to 1. If six, they are an
  // affine image of kCowper's, in its order.
  int n_points = 1;
  std::array<Eigen::Vector3d, kMaxPoints> points_mm;
  std::array<double, kMaxPoints> weights{};
  double radius_mm() const { return std::sqrt(2.0 * covariance_mm2.trace()); }
};

// The whole patch, sampled evenly: Cowper's six points, exact for polynomials of degree 4.
ExitSite exit_patch(const PatchMesh& patches, int patch_idx);
// The samples on a patch, given by their mean and covariance: the patch's six points under the
// smallest affine change that gives them this mean and covariance, so that the mean of any
// quadratic over the samples is exact, and that of higher degrees nearly so if the samples fill the
// patch. A covariance of rank below 2 is taken as a single point.
ExitSite exit_samples(const PatchMesh& patches, int patch_idx, const Eigen::Vector3d& mean_mm,
                      const Eigen::Matrix3d& covariance_mm2);
inline ExitSite exit_point(const Eigen::Vector3d& p_mm) {
  ExitSite site;
  site.center_mm = site.points_mm[0] = p_mm;
  site.weights[0] = 1.0;
  return site;
}
// The same site elsewhere.
ExitSite moved(const ExitSite& site, const Eigen::Vector3d& by_mm);

}  // namespace scattermeter
