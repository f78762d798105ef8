// Layouts of point pairs from which no pose can be had, recognised before and after the solving.
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

// kTooFewPoints or kCollinear by the positions alone, over the pairs whose `use` is set: fewer than
// four pairs, or different world points; world points on one line (second singular value below
// 1e-3 of the first, where three-point poses lose their digits) or at one place; image points on
// one line (rms distance from it below 3 noise_std_px) or at one place (4 noise_std_px).
std::optional<PoseFault> layout_fault(const std::vector<PointPair>& pairs,
                                      const std::vector<bool>& use, double noise_std_px);

// kCollinear when the world points' rms distance from their best line, seen at px_per_mm, is below
// 3 noise_std_px: the image then does not show that they are no line.
std::optional<PoseFault> seen_as_line_fault(const std::vector<PointPair>& pairs,
                                            const std::vector<bool>& use, double px_per_mm,
                                            double noise_std_px);

}  // namespace scattermeter::calib
