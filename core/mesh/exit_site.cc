#include "core/mesh/exit_site.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/mesh/triangle_parts.h"

namespace scattermeter {
namespace {

// Of a symmetric positive matrix, after Cayley and Hamilton.
Eigen::Matrix2d square_root(const Eigen::Matrix2d& m) {
  const double root_det = std::sqrt(m.determinant());
  return (m + root_det * Eigen::Matrix2d::Identity()) / std::sqrt(m.trace() + 2.0 * root_det);
}

// Barycentric weights of the lattice's points, in thirds.
constexpr std::array<std::array<int, 3>, 10> kLattice = {{{3, 0, 0},
                                                          {0, 3, 0},
                                                          {0, 0, 3},
                                                          {2, 1, 0},
                                                          {1, 2, 0},
                                                          {0, 2, 1},
                                                          {0, 1, 2},
                                                          {1, 0, 2},
                                                          {2, 0, 1},
                                                          {1, 1, 1}}};

}  // namespace

LatticeShares lattice_shares(const Eigen::Vector3d& barycentric) {
  LatticeShares shares;
  for (std::size_t at = 0; at < shares.size(); ++at) {
    // Of the shape functions, the product of (3 w - j) / (j + 1) over j below each weight's thirds.
    shares[at] = 1.0;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const double w = 3.0 * barycentric[static_cast<Eigen::Index>(corner)];
      for (int j = 0; j < kLattice[at][corner]; ++j) shares[at] *= (w - j) / (j + 1);
    }
  }
  return shares;
}

ExitSite exit_patch(const PatchMesh& patches, int patch_idx) {
  const Triangle t = patches.corners_mm(patch_idx);
  ExitSite site;
  site.center_mm = (t[0] + t[1] + t[2]) / 3.0;
  site.n_points = 6;
  std::size_t at = 0;
  for (const TriangleOrbit& orbit : kCowper) {
    for (const Eigen::Vector3d& corner : t) {
      site.points_mm[at] = site.center_mm + (orbit.a - orbit.b()) * (corner - site.center_mm);
      site.weights[at++] = orbit.weight;
    }
  }
  site.n_few = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr TriangleOrbit kFew = kThreePoints[0];
    site.few_mm[i] = site.center_mm + (kFew.a - kFew.b()) * (t[i] - site.center_mm);
  }
  // A triangle's covariance is a twelfth of its corners' scatter about the centre.
  for (const Eigen::Vector3d& p : t) {
    site.covariance_mm2 += (p - site.center_mm) * (p - site.center_mm).transpose() / 12.0;
  }
  return site;
}

ExitSite exit_samples(const PatchMesh& patches, int patch_idx, const Eigen::Vector3d& mean_mm,
                      const Eigen::Matrix3d& covariance_mm2, const LatticeShares* shares) {
  ExitSite site = exit_patch(patches, patch_idx);
  // In the patch's plane, two axes along its edges.
  const Triangle t = patches.corners_mm(patch_idx);
  Eigen::Matrix<double, 3, 2> plane;
  plane.col(0) = (t[1] - t[0]).normalized();
  plane.col(1) = patches.normal(patch_idx).cross(plane.col(0));
  const Eigen::Matrix2d from = plane.transpose() * site.covariance_mm2 * plane;
  const Eigen::Matrix2d to = plane.transpose() * covariance_mm2 * plane;
  if (!(to.determinant() > 1e-6 * to.trace() * to.trace())) return exit_point(mean_mm);
  // The symmetric map that carries one covariance to the other (of all maps the one that moves
  // points least): from^-1/2 (from^1/2 to from^1/2)^1/2 from^-1/2.
  const Eigen::Matrix2d root = square_root(from);
  const Eigen::Matrix2d inverse = root.inverse();
  const Eigen::Matrix2d map = inverse * square_root(root * to * root) * inverse;
  const auto carry = [&](Eigen::Vector3d& p) {
    p = mean_mm + plane * (map * (plane.transpose() * (p - site.center_mm)));
  };
  std::for_each(site.few_mm.begin(), site.few_mm.end(), carry);
  if (shares == nullptr) {
    std::for_each(site.points_mm.begin(), site.points_mm.begin() + site.n_points, carry);
  } else {
    site.n_points = static_cast<int>(shares->size());
    site.weights = *shares;
    for (std::size_t i = 0; i < shares->size(); ++i) {
      site.points_mm[i] =
          (kLattice[i][0] * t[0] + kLattice[i][1] * t[1] + kLattice[i][2] * t[2]) / 3.0;
    }
  }
  site.center_mm = mean_mm;
  site.covariance_mm2 = plane * to * plane.transpose();
  return site;
}

ExitSite moved(const ExitSite& site, const Eigen::Vector3d& by_mm) {
  ExitSite out = site;
  out.center_mm += by_mm;
  for (int i = 0; i < out.n_points; ++i) out.points_mm[static_cast<std::size_t>(i)] += by_mm;
  for (int i = 0; i < out.n_few; ++i) out.few_mm[static_cast<std::size_t>(i)] += by_mm;
  return out;
}

}  // namespace scattermeter
