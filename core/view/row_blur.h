// What blur in the picture does to the light of the rows.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/view/sample_map.h"

namespace scattermeter {

// The rows of a view. All sizes are those of `centers_mm`.
struct BlurredRows {
  const std::vector<Eigen::Vector3d>& centers_mm;          // world
  const std::vector<Eigen::Vector3d>& normals;             // unit, of the rows' patches, world
  const std::vector<std::vector<std::int32_t>>& adjacent;  // core/view/adjacent_rows.h
  Eigen::Vector3d camera_center_mm;                        // world
  Eigen::Matrix<double, 3, 2> picture_axes;                // right and down, world, unit
};

// Change of the rows' light by a point spread of this covariance, mm^2 along the picture's axes
// (right, down) on the object, at right angles to the line of sight: half the sum of the light's
// second derivatives along the surface, each times its covariance. From differences of the
// gradient among adjacent rows, so exact for light that is quadratic on a facet; of terms beyond
// the second derivatives nothing is known, nor across edges, beside which rows are guarded. A row
// without adjacent ones has no change. gradient_per_mm: of the light along the surface, 3 x rows.
// Throws std::invalid_argument where sizes differ.
Eigen::VectorXd change_by_blur(const BlurredRows& rows, const Eigen::Matrix3Xd& gradient_per_mm,
                               const Eigen::Matrix2d& covariance_mm2);

// What blur brings to each row across the edges beside it, or takes away, relative to its light: an
// upper bound, with the brightest light of the rows near by on the other side. light: of the rows.
// blur_px: standard deviation of the point spread.
std::vector<double> leaked_by_blur(const SampleMap& map, const std::vector<double>& light,
                                   double blur_px);

}  // namespace scattermeter
