// Choice of the lens model: the number of distortion terms, and one focal length or two.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/lens/camera_bundle.h"

namespace scattermeter::calib {

struct LensCandidate {
  LensModel model;
  double rms_px = 0;           // over the corners, of the 2-vector's length
  double left_out_rms_px = 0;  // the same for views not used in the fit; NaN if unusable
  std::string fault;           // why it cannot be used; "" if it can
};

struct LensChoice {
  std::vector<LensCandidate> candidates;  // those of fewer parameters first
  std::optional<std::size_t> chosen;      // none: no candidate can be used
  CameraBundle bundle;                    // of the chosen one
};

// Cross-validation: each view in turn is left out, the lens is fitted to the others, and the
// corners of the view are compared with it, with the best pose for them. The refit is one
// Gauss-Newton step from the fit to all views, r + A (S - S_i)^-1 g_i (calib/lens/camera_bundle.h),
// which is exact up to terms of second order in the error of the parameters. The model chosen is
// the one with the fewest parameters whose sum of squares exceeds the smallest one by no more than
// half the standard error of the difference, with views taken as independent: roughly, a term is
// kept if it is significant at two standard deviations. With fewer than four views no
// cross-validation is possible, and the model is fx = fy, k1 and k2. k1 alone is not tried: a k2
// too small to be significant biases it by several of its stated standard deviations (3.7 rms over
// 50 simulated calibrations). The scatter due to the choice itself is not part of the covariance:
// over 50 calibrations from raw files of a lens with k1 and k2, the ratio of predicted to sampled
// standard deviation was 1.06 for f, 0.85 and 0.96 for the centre, but 0.75 for k1 and 0.56 for k2,
// whose effect is shared with k3 when that was chosen. A model is unusable if its fit does not
// converge or is not determined, with or without any one view, or if its distortion folds back
// within the frame.
LensChoice choose_lens(const std::vector<BoardView>& views, int width_px, int height_px,
                       const CameraBundle& start, const std::optional<LensModel>& only);

}  // namespace scattermeter::calib
