// Search for the single change of the rig that best explains a displaced outline.
#pragma once

#include <string>
#include <vector>

#include "calib/pose/edge_fit.h"
#include "calib/pose/pose.h"

namespace scattermeter::calib {

enum class EdgeCause {
  kNone,               // the rig as it is, within the uncertainty of its pose
  kCameraTurned,       // about its own centre
  kCameraMoved,        // without turning
  kMeshScale,          // of one body, about the world's origin
  kAllMeshScales,      // of all bodies alike
  kFocalLength,        // with its radial distortion
  kCameraTurnedMoved,  // both
};

struct EdgeExplanation {
  EdgeCause cause = EdgeCause::kNone;
  int body_idx = -1;  // of kMeshScale
  double value = 0;   // deg (turned; of both, the turn), mm, or relative
  double std = 0;     // of `value`
  std::string text;   // "camera turned by 0.98 +- 0.03 deg"
  double rms_px = 0;  // of the remaining residuals
  double chi2 = 0;
  int parameters = 0;
  bool explains = false;  // the remaining residuals agree with the noise (p above 1e-4)
};

struct EdgeDiagnosis {
  bool agrees = false;                 // nothing contradicts the rig (p above 1e-4)
  bool is_unambiguous = false;         // one cause explains it, and no other does as well
  EdgeCause cause = EdgeCause::kNone;  // the best of those that explain; kNone if none does
  int body_idx = -1;
  std::string verdict;  // a sentence, which also names causes that cannot be distinguished
  std::vector<EdgeExplanation> explanations;  // all causes tried, kNone first
  double line_std_px = 0;                     // scatter that no change explains; basis of the tests
  double piece_std_px = 0;
  std::vector<double> residual_px;  // one per point, after the fit of all causes together
};

struct EdgeExplanationOptions {
  double line_std_px = 0.1;       // see SilhouetteOptions
  double focal_relative_std = 0;  // uncertainty in the rig; 0: exact
  double k1_std = 0;              // likewise of the radial distortion
  double scale_relative_std = 0;  // of each mesh
};

// Each cause is fitted together with the pose within its covariance. The scatter is that of the fit
// of all causes at once, so that a wrong rig is not mistaken for a noisy one. Among the causes that
// explain the outline, the best has the smallest chi2 + parameters ln(2 lines) (G. Schwarz,
// "Estimating the dimension of a model", 1978). Another within 6 of it cannot be distinguished from
// it. One with more parameters that fits as well (chi2 within 9) is named, too: meshes that are all
// too small look the same as a camera moved towards the world's origin. With the same body in all
// shots, a moved body cannot be distinguished from a moved camera, nor the scale of the body from
// that of all bodies. names: of the bodies. Throws std::invalid_argument without points.
EdgeDiagnosis explain_edges(const std::vector<EdgePoint>& points,
                            const CameraIntrinsics& intrinsics, const PoseResult& pose,
                            const std::vector<std::string>& names,
                            const EdgeExplanationOptions& options = {});

}  // namespace scattermeter::calib
