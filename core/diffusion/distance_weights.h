// The linear system between the image and the diffuse reflectance: l = W r.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/diffusion/pair_sums.h"

namespace scattermeter {

// Rows: exit sites. Columns: knots. l_j (W/mm^2) = I (W/sr) * sum over i of weights(j, i) r_i, with
// r_i = R(knot i) in 1/mm^2, so weights are in sr (paper eq. 26 to 28).
using WeightMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Distances at which the smooth system represents r, shared by all shots of a measurement.
// Evenly spaced in the logarithm of s = d^2 + s0; between knots r is a quintic in log s. With 6
// knots an octave the interpolation of a dipole is relatively wrong by less than 6e-6 wherever
// z_r^2 >= s0 and R is more than 1e-4 of R(0) (twice as many knots and cubics: 3e-5; test: knots
// against quadrature).
class DistanceKnots {
 public:
  // Throws std::invalid_argument unless 0 < resolution_mm < max_distance_mm.
  // s0 is at most resolution_mm^2: structure of R finer than resolution_mm cannot be resolved.
  // fine_bits: pairs are first sorted into 2^fine_bits bins per octave, between which R is taken as
  // linear: a relative error of at most 0.4 4^-fine_bits, as often above as below.
  DistanceKnots(double resolution_mm, double max_distance_mm, int per_octave = 6,
                int fine_bits = 7);

  int size() const { return static_cast<int>(knots_mm_.size()); }
  const std::vector<double>& knots_mm() const { return knots_mm_; }
  double resolution_mm() const { return resolution_mm_; }
  double max_distance_mm() const { return max_distance_mm_; }
  const OctaveBins& fine_bins() const { return bins_; }
  // Transfers sums over fine bins to the knots: out = B^T fine.
  void fold(const float* fine, double* out) const;

 private:
  static constexpr int kStencil = 6;
  // Shares of a fine bin's sum that go to its knots; padded with zeros to full lanes.
  using Shares = Eigen::Array<float, 8, 1>;
  // Neighbouring fine bins between the same knots.
  struct Run {
    int bins;
    int first_knot;
    std::size_t shares;  // index in `shares_` of the shares of its first bin
  };
  Shares shares(int bin, int first_knot) const;

  double resolution_mm_;
  double max_distance_mm_;
  int per_octave_;
  OctaveBins bins_;
  std::vector<double> knots_mm_;
  std::vector<Run> runs_;
  std::vector<Shares> shares_;  // octaves are alike: stored for one, and for both ends
};

// W on smooth knots, rounded to single precision. Rows are computed in parallel, each by one
// thread.
WeightMatrix smooth_weights(const std::vector<ExitSite>& sites, const SourceCloud& sources,
                            const DistanceKnots& knots, const PairSumOptions& options);

// W r for some r on the knots, one per column: rows x columns of r. Rows of W are not stored.
Eigen::MatrixXd smooth_images(const std::vector<ExitSite>& sites, const SourceCloud& sources,
                              const DistanceKnots& knots, const PairSumOptions& options,
                              const Eigen::MatrixXd& r);

// W on the paper's uniform knots i * width, i = 0 .. n - 1.
WeightMatrix uniform_weights(const std::vector<ExitSite>& sites, const SourceCloud& sources,
                             const UniformBins& bins, const PairSumOptions& options);

}  // namespace scattermeter
