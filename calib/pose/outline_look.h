// A quick look at where a body's outline is in a shot.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "calib/pose/outline_contour.h"
#include "capture/raw/raw_frame.h"
#include "core/camera/sensor_noise.h"

namespace scattermeter::calib {

// Where one point of the contour is seen: its distance from the predicted position along
// ContourPoint::outward, px.
struct OutlineOffset {
  std::size_t point_idx = 0;
  double px = 0;
};

struct OutlineLook {
  std::size_t points = 0;              // of the contour, within the frame
  std::vector<OutlineOffset> offsets;  // of those that were found, ascending
  // The shift of the whole outline (right, down) about which the search was repeated; 0 if most
  // points were found near their positions.
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  double cell_px = 0;  // size of the cells; an offset is good to some tenths of it
  double found_share() const {
    return points == 0 ? 0.0 : static_cast<double>(offsets.size()) / static_cast<double>(points);
  }
};

// Size of the cells on which look_at_outline() works, px of the raw file.
int outline_cell_px(int width_px);

// Looks for each point of the contour along its normal, from the background inwards, on cells of
// the frame: the first step from dark to bright that exceeds eight standard deviations of the noise
// and 0.3 % of the brightest cell. The search reaches 12 cells to each side. If fewer than half of
// the points are found, or half of them are off by more than 6 cells, it is repeated about the
// shift of the whole contour, up to `search` of the frame's width, with the highest contrast. Takes
// milliseconds; the careful search is find_silhouette(). Clipped samples count as bright.
OutlineLook look_at_outline(const std::vector<ContourPoint>& contour,
                            const capture::RawFrame& frame, const SensorNoise& noise,
                            double search = 0.2);

}  // namespace scattermeter::calib
