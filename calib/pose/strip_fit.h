// The linear part of locating an edge: brightnesses on both sides, for a given offset and blur.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "calib/pose/edge_shape.h"

namespace scattermeter::calib {

struct StripSample {
  double s;  // along outward from where the edge is looked for, px
  double signal_counts;
  double dark_variance_counts2;  // without photon noise, > 0
  int channel;                   // 0, 1 or 2
};

// The model of locate_edge() (edge_strip.h) at an offset and a blur: each channel's brightnesses
// b, a_0, a_1, a_2 [, c] are linear and solved for; offset and blur are the caller's.
class StripFit {
 public:
  // `normal`: unit vector across the edge in the image. `per_count`: photon variance per count.
  // With `both_bright` the brightness outside has a slope c.
  StripFit(std::vector<StripSample> samples, const Eigen::Vector2d& normal, double per_count,
           bool both_bright);

  int unknowns() const { return channels_ * columns_ + 2; }
  double samples() const { return static_cast<double>(samples_.size()); }

  // Best brightnesses for this edge, kept with what they predict: returns chi2, infinite where it
  // is not finite.
  double solve(double offset, double blur);

  // Weights from what the last solve() predicts.
  void reweigh();

  // Information about (offset, blur) with the brightnesses eliminated, and the gradient of -chi2/2:
  // of a Gauss-Newton step. After solve(offset, blur).
  Eigen::Matrix2d information(double offset, double blur, Eigen::Vector2d* gradient) const;

  // Signal to noise of the step a_0 over all channels, and its sign summed over the channels. After
  // solve().
  double snr(double* sign) const;

 private:
  Eigen::RowVectorXd row(const EdgeShape& shape, double offset, std::size_t i) const;

  std::vector<StripSample> samples_;
  Eigen::Vector2d normal_;
  double per_count_;
  int columns_;
  int channels_ = 0;
  std::vector<double> weights_;
  std::vector<double> predicted_;
  Eigen::MatrixXd basis_;
  Eigen::MatrixXd linear_;  // column a channel: b, a_0, a_1, a_2 [, c]
  std::vector<Eigen::MatrixXd> normal_matrix_;
};

}  // namespace scattermeter::calib
