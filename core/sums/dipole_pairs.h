// Direct sums of the dipole over pairs of points, in single precision, many pairs at once.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/material/dipole.h"

namespace scattermeter {

// Sum over sources of c_k R(|x - x_k|), c_k in any unit, and its derivatives.
struct DipoleSum {
  double value = 0;              // unit of c / mm^2
  double per_sigma_s_prime = 0;  // by sigma_s', 1/mm
  double per_sigma_a = 0;        // by sigma_a, 1/mm
};

// The sums from which the three are combined: with g_i = z_i (1 + x_i) exp(-x_i) / rho_i^3
// of core/material/dipole.h, over both poles, the sums of c g, of c z dg/dz and of c dg/d(kappa^2).
struct PoleSum {
  double value = 0;     // unit of c / mm^2
  double z_d_z = 0;     // unit of c / mm^2
  double d_kappa2 = 0;  // unit of c
};

// The sums for a medium from those of its poles.
DipoleSum dipole_sum(const Medium& medium, const PoleSum& poles);

// Weighted points in blocks of neighbours in the given order. Within a block positions are floats
// relative to the block's centre, so that distances do not depend on where the world's origin is.
// Blocks whose weights are all 0 are left out.
class PairSources {
 public:
  // Domain: as many weights as points, all finite (std::invalid_argument).
  PairSources(std::span<const Eigen::Vector3d> points_mm, std::span<const double> weights);
  std::size_t size() const { return size_; }

 private:
  friend class DipolePairs;
  static constexpr std::size_t kBlock = 256;
  struct Block {
    Eigen::Vector3d origin_mm;
    double weight;  // value of a stored weight of 1
    std::size_t first, count;
  };
  std::size_t size_ = 0;
  std::vector<Block> blocks_;
  std::vector<float> x_, y_, z_, c_;
};

// Direct sums for the dipole of one medium. The instruction set is the best that the processor
// has (Highway's run-time dispatch). Measured against long double: relative error of a sum of
// positive weights at most 1e-6 in each of the three, relative to the sum of the absolute terms for
// the derivatives, as long as the sum exceeds 1e-37 of that with all sources at the site
// (tests/core/sums/dipole_pairs_test.cc).
class DipolePairs {
 public:
  explicit DipolePairs(const Medium& medium);  // std::invalid_argument as Dipole

  // One sum for each site; 16 sites at a time cost as much as one. std::invalid_argument unless
  // there are as many sums as sites.
  void sum(const PairSources& sources, std::span<const Eigen::Vector3d> sites_mm,
           std::span<DipoleSum> out) const;

 private:
  Medium medium_;
  double z_r_mm_, z_v_mm_, kappa_per_mm_;
};

}  // namespace scattermeter
