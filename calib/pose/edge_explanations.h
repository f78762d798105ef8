// The single change of the rig that best explains an outline that is not where it should be.
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
  double std = 0;     // of the same
  std::string text;   // "camera turned by 0.98 +- 0.03 deg"
  double rms_px = 0;  // of what it leaves
  double chi2 = 0;
  int parameters = 0;
  bool explains = false;  // what it leaves is no more than the noise allows (p above 1e-4)
};

struct EdgeDiagnosis {
  bool agrees = false;                 // nothing contradicts the rig (p above 1e-4)
  bool is_unambiguous = false;         // one cause explains, and no other does as well
  EdgeCause cause = EdgeCause::kNone;  // the best of those that explain; kNone if none does
  int body_idx = -1;
  std::string verdict;                        // a sentence; says what cannot be told apart
  std::vector<EdgeExplanation> explanations;  // all that were tried, the first is kNone
  double line_std_px = 0;  // scatter that no change explains, on which the tests rest
  double piece_std_px = 0;
  std::vector<double> residual_px;  // one per point, after the fit of all causes together
};

struct EdgeExplanationOptions {
  double line_std_px = 0.1;       // see SilhouetteOptions
  double focal_relative_std = 0;  // how well the rig knows it; 0: exactly
  double k1_std = 0;              // the same for the radial distortion
  double scale_relative_std = 0;  // of each mesh
};

// Each cause is fitted on top of the pose within its covariance; scatter is taken from the fit of
// all causes at once, so that a wrong rig does not pass as a noisy one. Among causes that explain,
// the least chi2 + parameters ln(2 lines) is the best (G. Schwarz, "Estimating the dimension of a
// model", 1978); another within 6 of it cannot be told from it; one with
// more parameters that fits as well (chi2 within 9) is named, too: all meshes too small is the same
// picture as a camera moved towards the world's origin. With one body in all shots, a moved
// body and a moved camera are one and the same; so are body and scene. names: of the bodies.
// Precondition (std::invalid_argument): at least one point.
EdgeDiagnosis explain_edges(const std::vector<EdgePoint>& points,
                            const CameraIntrinsics& intrinsics, const PoseResult& pose,
                            const std::vector<std::string>& names,
                            const EdgeExplanationOptions& options = {});

}  // namespace scattermeter::calib
