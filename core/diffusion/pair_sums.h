// Sums over pairs of exit and entry points, sorted by distance.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/diffusion/distance_bins.h"
#include "core/diffusion/power_moments.h"
#include "core/light/incident_light.h"
#include "core/mesh/exit_site.h"

namespace scattermeter {

struct PairSumOptions {
  // A cluster of sources stands for its members where the distance between its centroid and the
  // site's centre is at least this many times the sum of their radii. Both are then replaced by
  // points that keep the mean and the covariance of the difference vector, so the error is of third
  // order in radius / distance. Measured on a plane and a cube against adaptive quadrature: see
  // tests/core/diffusion/pair_sums_test.cc.
  double far_ratio = 6.0;
  // Nearer lit triangles are integrated from each of the site's points: cut until they are smaller
  // than distance / near_ratio or than floor_mm.
  double near_ratio = 1.0;
  // A lit triangle at least this many times its edge and the site's radius away is three points,
  // seen from three: exact for polynomials of degree 2 in both. Nearer, both are six (degree 4).
  double few_points_ratio = 2.5;
  double floor_mm = 0.02;
};

// The lit surface, ready for summing: a binary tree of clusters with power, centroid and
// covariance, in single precision relative to `origin_mm`.
class SourceCloud {
 public:
  SourceCloud(const IncidentLight& light, const Eigen::Vector3d& origin_mm);

  std::size_t size() const { return rules_.size(); }
  // Sites that share a walk through the tree.
  static constexpr std::size_t kSideBySide = 8;
  // Adds, for the mean over each site, the entering power of every source at its distance:
  // afterwards sum over i of sums[i] f(d_i) is the mean over the site of
  // ∫ E(x) f(|x_site - x|) dA, for any f that the bins represent. sums: bins.size() values a site,
  // one site behind the other, in sr. Sites that stand side by side in space are quicker; the
  // digits of each are its own.
  template <class Bins>
  void add_to(std::span<const ExitSite> sites, const Bins& bins, const PairSumOptions& options,
              typename Bins::Sum* sums) const;

 private:
  // Lit triangles [begin, end) in the order of the tree. The left child stands right behind its
  // parent; right < 0: a single triangle.
  struct Node {
    float x, y, z;                 // centroid of the power
    float power;                   // sr
    float radius;                  // no part of the cluster is farther from the centroid
    float xx, xy, xz, yy, yz, zz;  // covariance of the power about the centroid, mm^2
    std::int32_t triangle;         // of a leaf
    std::int32_t right;
  };
  // A lit triangle as points about its centroid, for sites that are farther away than it is large:
  // six, or three for sites a good deal farther. Zeros fill the lanes.
  template <int kLanes>
  struct Points {
    using Lanes = Eigen::Array<float, kLanes, 1>;
    Lanes x = Lanes::Zero(), y = Lanes::Zero(), z = Lanes::Zero(), power = Lanes::Zero();
  };
  struct Rule {
    Eigen::Vector3f center;
    float edge;       // the longest
    Points<4> three;  // kThreePoints
    Points<8> six;    // kCowper
    // For sites so near that it is cut.
    float density, area;                    // the mean one in sr / mm^2; mm^2
    std::array<Eigen::Vector3f, 3> corner;  // from the centroid
    std::array<float, 3> rise;              // of the density from the centroid to a corner
    Eigen::Vector3d precise_center;
  };
  static Rule rule_of(const LitTriangle& t);
  template <class Bins>
  class Sum;
  template <class Bins>
  class Group;
  PowerMoments build(const std::vector<PowerMoments>& leaves, std::int32_t* begin,
                     std::int32_t* end);

  Eigen::Vector3d origin_mm_;
  std::vector<Node> nodes_;
  std::vector<Rule> rules_;  // relative to the origin, in the order of the tree
};

}  // namespace scattermeter
