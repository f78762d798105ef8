// Mean of the samples of a white plane in a cell, without dust and hot pixels.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace scattermeter::calib {

// A sample of one channel: where its ray meets the plane (in the axes of the plane), and its
// signal.
struct PlaneSample {
  float x_mm, y_mm;
  float signal_counts, variance_counts2;
};

struct CellMean {
  Eigen::Vector2d position_mm;
  Eigen::Matrix2d spread_mm2;  // covariance of the samples' positions
  double signal_counts;
  double variance_counts2;  // of signal_counts
  std::size_t spots;        // number of samples left out
};

inline constexpr std::size_t kLeastCellSamples = 12;

// The unweighted mean of the samples that lie within five standard deviations (of their noise, or
// of the bulk of all residuals if that is larger) of the linear trend of the samples kept, in at
// most five rounds. None with fewer than kLeastCellSamples samples, if more than the share
// `max_left_out` of them is left out, or if the positions lie on a line.
std::optional<CellMean> robust_cell_mean(const std::vector<PlaneSample>& samples,
                                         double max_left_out);

}  // namespace scattermeter::calib
