// What each of some batches of paths departs from their mean, in a byte a number.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace scattermeter {

// Departures of the batches' sums in one row from the mean over the batches, at several tilts.
// Those of neighbouring tilts are nearly alike, and light combines them with weights of either sign
// whose sums over the last tilts, however many, are at most 1.3 for sigma_a up to a tenth of
// sigma_s and 1.8 for any. So each tilt but the first is kept as its difference from the one before
// it, as whole numbers from -127 to 127 of a step of the row's own: an error of at most half a
// step, with a variance of some 1e-3 of that of the batches where they are normal.
struct PackedBatches {
  using Bytes = Eigen::Matrix<std::int8_t, Eigen::Dynamic, Eigen::Dynamic>;
  std::vector<Bytes> steps;              // by tilt: batches x rows
  std::vector<Eigen::VectorXf> step_of;  // by tilt: by row; 0 where all batches are alike

  PackedBatches() = default;
  // Without departures.
  PackedBatches(std::size_t tilts, Eigen::Index batches, Eigen::Index rows);

  // Adds sums of further paths, batches x rows for each tilt, and rounds again.
  void add(const std::vector<Eigen::MatrixXf>& sums);
  // Of the combination of the tilts with these weights: batches x rows.
  Eigen::MatrixXf combined(const Eigen::VectorXd& weights) const;
};

}  // namespace scattermeter
