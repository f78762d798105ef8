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

// Appends to the site's points those of a rule on the triangle under the smallest affine change
// that gives them the samples' mean and covariance, a single point where that has rank below 2.
// plane: two orthonormal axes in it. Returns false for a single point.
bool append(const Triangle& t, std::span<const TriangleOrbit> rule,
            const Eigen::Matrix<double, 3, 2>& plane, const SampleSpread& samples, ExitSite& site) {
  const Eigen::Vector3d center_mm = middle_mm(t);
  Eigen::Matrix2d from = Eigen::Matrix2d::Zero();
  // A triangle's covariance is a twelfth of its corners' scatter about the centre.
  for (const Eigen::Vector3d& p : t) {
    const Eigen::Vector2d q = plane.transpose() * (p - center_mm);
    from += q * q.transpose() / 12.0;
  }
  const auto add = [&](const Eigen::Vector3d& p, double weight) {
    const auto at = static_cast<std::size_t>(site.n_points++);
    site.points_mm[at] = p;
    site.weights[at] = weight;
  };
  const Eigen::Matrix2d to = plane.transpose() * samples.covariance_mm2 * plane;
  if (!(to.determinant() > 1e-6 * to.trace() * to.trace())) {
    add(samples.mean_mm, samples.share);
    return false;
  }
  // The symmetric map that carries one covariance to the other (of all maps the one that moves
  // points least): from^-1/2 (from^1/2 to from^1/2)^1/2 from^-1/2.
  const Eigen::Matrix2d root = square_root(from);
  const Eigen::Matrix2d inverse = root.inverse();
  const Eigen::Matrix2d map = inverse * square_root(root * to * root) * inverse;
  for (const TriangleOrbit& orbit : rule) {
    for (const Eigen::Vector3d& corner : t) {
      const Eigen::Vector2d from_center = plane.transpose() * (corner - center_mm);
      add(samples.mean_mm + plane * (map * ((orbit.a - orbit.b()) * from_center)),
          samples.share * orbit.weight);
    }
  }
  return true;
}

// The three points of the rule of three, from the last three of the rule of six, which are in the
// same directions, but farther out.
void set_few(ExitSite& site) {
  constexpr TriangleOrbit kSix = kCowper[1], kThree = kThreePoints[0];
  constexpr double kCloser = (kThree.a - kThree.b()) / (kSix.a - kSix.b());
  site.n_few = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    site.few_mm[i] = site.center_mm + kCloser * (site.points_mm[i + 3] - site.center_mm);
  }
}

}  // namespace

ExitSite exit_patch(const PatchMesh& patches, int patch_idx) {
  const Triangle t = patches.corners_mm(patch_idx);
  SampleSpread all;
  all.share = 1.0;
  all.mean_mm = middle_mm(t);
  for (const Eigen::Vector3d& p : t) {
    all.covariance_mm2 += (p - all.mean_mm) * (p - all.mean_mm).transpose() / 12.0;
  }
  return exit_samples(patches, patch_idx, all);
}

ExitSite exit_samples(const PatchMesh& patches, int patch_idx, const SampleSpread& all,
                      std::span<const SampleSpread> of_quarters) {
  const Triangle t = patches.corners_mm(patch_idx);
  // In the patch's plane, two axes along its edges.
  Eigen::Matrix<double, 3, 2> plane;
  plane.col(0) = (t[1] - t[0]).normalized();
  plane.col(1) = patches.normal(patch_idx).cross(plane.col(0));
  ExitSite site;
  site.n_points = 0;
  if (!append(t, kCowper, plane, all, site)) return exit_point(all.mean_mm);
  site.center_mm = all.mean_mm;
  site.covariance_mm2 =
      plane * (plane.transpose() * all.covariance_mm2 * plane) * plane.transpose();
  set_few(site);
  if (of_quarters.empty()) return site;
  site.n_points = 0;
  const std::array<Triangle, 4> parts = quarters(t);
  for (std::size_t q = 0; q < parts.size(); ++q) {
    if (of_quarters[q].share > 0.0) append(parts[q], kThreePoints, plane, of_quarters[q], site);
  }
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
