// The linear part of locating an edge: the brightnesses on both sides for a given offset and blur.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "calib/pose/edge_shape.h"

namespace scattermeter::calib {

struct StripSample {
  double s;  // along outward from the expected position of the edge, px
  double signal_counts;
  double dark_variance_counts2;  // without photon noise, > 0
  int channel;                   // 0, 1 or 2
};

// The model of locate_edge() (edge_strip.h) at an offset and a blur: each channel's brightnesses
// b, a_0, a_1, a_2 [, c] are linear and solved for; offset and blur are chosen by the caller.
class StripFit {
 public:
  static constexpr int kMostColumns = kEdgeTerms + 2;

  // `normal`: unit vector across the edge in the image. `per_count`: photon variance per count.
  // With `both_bright` the brightness outside has a slope c.
  StripFit(std::vector<StripSample> samples, const Eigen::Vector2d& normal, double per_count,
           bool both_bright);

  int unknowns() const { return channels_ * columns_ + 2; }
  double samples() const { return static_cast<double>(samples_.size()); }

  // Finds the best brightnesses for this edge and stores them with their predictions. Returns chi2,
  // or infinity if it is not finite.
  double solve(double offset, double blur);

  // Updates the weights from the predictions of the last solve().
  void reweigh();

  // Information about (offset, blur) with the brightnesses eliminated, and the gradient of -chi2/2,
  // for a Gauss-Newton step. To be called after solve().
  Eigen::Matrix2d information(Eigen::Vector2d* gradient) const;

  // Signal-to-noise ratio of the step a_0 over all channels, and its sign summed over the channels.
  // To be called after solve().
  double snr(double* sign) const;

 private:
  using Column = Eigen::Matrix<double, kMostColumns, 1>;
  using Square = Eigen::Matrix<double, kMostColumns, kMostColumns>;

  std::vector<StripSample> samples_;
  Eigen::Vector2d normal_;
  double per_count_;
  int columns_;
  int channels_ = 0;
  std::vector<double> weights_;
  std::vector<double> predicted_;
  std::vector<EdgeShape::Terms> terms_;  // by sample
  // By sample: 1, S_0, S_1, S_2, s or, without a slope, 0.
  std::vector<Column> basis_;
  std::array<Column, 3> linear_;         // by channel: b, a_0, a_1, a_2, c
  std::array<Square, 3> normal_matrix_;  // by channel; without a slope, that of a c of 0
};

}  // namespace scattermeter::calib
