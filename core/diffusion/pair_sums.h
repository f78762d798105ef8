// Sums over pairs of exit and entry points, sorted by distance.
#pragma once

#include <cstddef>
#include <span>

#include "core/diffusion/distance_bins.h"
#include "core/diffusion/source_cloud.h"
#include "core/mesh/exit_site.h"

namespace scattermeter {

struct PairSumOptions {
  // A cluster of sources represents its members where the distance between its centroid and the
  // site's centre is at least this many times the sum of their radii. Both are then replaced by
  // points that keep the mean and the covariance of the difference vector, so the error is of third
  // order in radius / distance. Measured on a plane and a cube against adaptive quadrature: see
  // tests/core/diffusion/pair_sums_test.cc.
  double far_ratio = 6.0;
  // Nearer lit triangles are integrated from each of the site's points, cut until they are smaller
  // than distance / near_ratio or than floor_mm.
  double near_ratio = 1.0;
  // A lit triangle at least this many times its edge and the site's radius away is represented by
  // three points, as is the site: exact for polynomials of degree 2 in both. Nearer, both are
  // represented by six (degree 4).
  double few_points_ratio = 2.5;
  double floor_mm = 0.02;
};

// Sites that share one traversal of the tree.
inline constexpr std::size_t kSitesSideBySide = 8;

// Adds, for the mean over each site, the entering power of every source at its distance:
// afterwards the sum over the knots i, of what they hold times f(d_i), is the mean over the site of
// ∫ E(x) f(|x_site - x|) dA, for any f that the bins represent. sums: bins.sums() values per site,
// one site after the other, in sr. Sites close together in space are processed faster; the result
// of each does not depend on the others. Bins: UniformBins or OctaveBins.
template <class Bins>
void add_pair_sums(const SourceCloud& cloud, std::span<const ExitSite> sites, const Bins& bins,
                   const PairSumOptions& options, typename Bins::Sum* sums);

}  // namespace scattermeter
