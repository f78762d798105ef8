// The mean of a white plane's samples in a cell, without dust and hot pixels.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace scattermeter::calib {

// One channel's sample: where its ray meets the plane (in the plane's axes), and its light.
struct PlaneSample {
  float x_mm, y_mm;
  float signal_counts, variance_counts2;
};

struct CellMean {
  Eigen::Vector2d position_mm;
  Eigen::Matrix2d spread_mm2;  // covariance of the samples' positions
  double signal_counts;
  double variance_counts2;  // of signal_counts
  std::size_t spots;        // samples left out
};

inline constexpr std::size_t kLeastCellSamples = 12;

// The unweighted mean of the samples that lie within five standard deviations of the linear trend
// of those kept (of their noise, or of the bulk of all residuals where that is wider), in at most
// five rounds. None with fewer than kLeastCellSamples, with more than the share `max_left_out` of
// the samples left out, or where the positions lie on a line.
std::optional<CellMean> robust_cell_mean(const std::vector<PlaneSample>& samples,
                                         double max_left_out);

}  // namespace scattermeter::calib
