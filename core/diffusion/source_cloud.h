// A tree of clusters over the lit surface, for sums over its points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/diffusion/power_moments.h"
#include "core/light/incident_light.h"
#include "core/sums/pair_kernels.h"

namespace scattermeter {

// A binary tree of clusters with power, centroid and covariance, in single precision relative to
// `origin_mm`, and the rules that replace each lit triangle by points.
class SourceCloud {
 public:
  // Lit triangles [begin, end) in the order of the tree. The left child follows its parent
  // immediately; right < 0: a single triangle.
  struct Node {
    float x, y, z;                 // centroid of the power
    float power;                   // sr
    float radius;                  // no part of the cluster is farther from the centroid
    float xx, xy, xz, yy, yz, zz;  // covariance of the power about the centroid, mm^2
    std::int32_t triangle;         // of a leaf: index into rules()
    std::int32_t right;
  };
  // A lit triangle as points about its centroid, for sites that are farther away than it is large:
  // six, or three for sites considerably farther.
  struct Rule {
    Eigen::Vector3f center;
    float edge;             // the longest
    SourcePoints<4> three;  // kThreePoints
    SourcePoints<8> six;    // kCowper
    // For sites so near that the triangle is subdivided.
    float density, area;                    // the mean density in sr / mm^2; mm^2
    std::array<Eigen::Vector3f, 3> corner;  // from the centroid
    std::array<float, 3> rise;              // of the density from the centroid to a corner
    Eigen::Vector3d precise_center;
  };

  SourceCloud(const IncidentLight& light, const Eigen::Vector3d& origin_mm);

  // Number of lit triangles.
  std::size_t size() const { return rules_.size(); }
  const Eigen::Vector3d& origin_mm() const { return origin_mm_; }
  // The root first; empty without light.
  const std::vector<Node>& nodes() const { return nodes_; }
  // Relative to the origin, in the order of the tree's leaves.
  const std::vector<Rule>& rules() const { return rules_; }

 private:
  PowerMoments build(const std::vector<PowerMoments>& leaves, std::int32_t* begin,
                     std::int32_t* end);

  Eigen::Vector3d origin_mm_;
  std::vector<Node> nodes_;
  std::vector<Rule> rules_;
};

}  // namespace scattermeter
