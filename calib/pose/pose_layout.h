// Detection of layouts of point pairs that do not determine a pose, before and after solving.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/pose/pose.h"

namespace scattermeter::calib {

struct PoseFault {
  PoseStatus status;
  std::string message;  // for the user: what is wrong, what to do
};

// kTooFewPoints or kCollinear from the positions alone, over the pairs whose `use` is set: fewer
// than four pairs or different world points; world points on one line (second singular value below
// 1e-3 of the first, where three-point poses lose precision) or at one position; image points on
// one line (rms distance from it below 3 noise_std_px) or at one position (4 noise_std_px).
std::optional<PoseFault> layout_fault(const std::vector<PointPair>& pairs,
                                      const std::vector<bool>& use, double noise_std_px);

// kCollinear when the rms distance of the world points from their best line, at a scale of
// px_per_mm, is below 3 noise_std_px: in the image the points then cannot be distinguished from a
// line.
std::optional<PoseFault> seen_as_line_fault(const std::vector<PointPair>& pairs,
                                            const std::vector<bool>& use, double px_per_mm,
                                            double noise_std_px);

}  // namespace scattermeter::calib
