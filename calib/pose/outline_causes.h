// What an outline seen away from its place says about a rig: a joint linear model of its causes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "calib/pose/outline_model.h"
#include "core/camera/camera_model.h"
#include "core/camera/camera_pose.h"
#include "core/camera/pose_shift.h"

namespace scattermeter::calib {

enum class OutlineCause {
  kNone,           // the rig as it is, within its stated uncertainties
  kMeshDisplaced,  // of one body, by a shift in the world
  kMeshTurned,     // of one body, about its centre
  kMeshScale,      // of one body, about its centre
  kMeshMisplaced,  // of one body, displaced and turned
  kCamera,         // turned and moved, with at least two bodies
  kShotMoved,      // the picture of one shot against that of the other shots
};

struct OutlineExplanation {
  OutlineCause cause = OutlineCause::kNone;
  std::size_t which = 0;  // index of the body, or of the shot (kShotMoved)
  int parameters = 0;
  double chi2 = 0;
  // From what the rig states to what the shots show: mm (displaced), rad (turned), both
  // (misplaced, turn last), ln (scale), px (shot), the correction of the pose (camera).
  Eigen::VectorXd value;
  Eigen::MatrixXd covariance;
  std::string text;  // "mesh of cube displaced: ..."
};

struct OutlineDiagnosis {
  // No cause beyond the stated uncertainties is needed: its chi-square would drop by less than
  // chance gives once in 10^4 for each cause.
  bool agrees = true;
  // The rig as it is first, then the causes, the best first (chi2 + parameters ln(points)).
  std::vector<OutlineExplanation> explanations;
  std::size_t likely = 0;  // how many causes from the second on cannot be told apart (within 6)
  // Share of the points that were found and lie within four robust standard deviations of the joint
  // fit, by shot.
  std::vector<double> fitting_share;
  // Mean shift of all outlines, right and down, and its standard deviation without that of pose and
  // place.
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  double shift_std_px = 0;
  // Of each body, if the outlines show that pose and place are off by a part of their stated
  // uncertainty (p below 10^-4): the shift from the given pose to the most probable one relative to
  // the body. Empty otherwise.
  std::vector<PoseShift> shifts;
  // Of each body: by how much its contour lies farther out than its mesh's, pose, place and size as
  // stated.
  std::vector<double> growth_px;
};

// Whether a displacement or turn of the body beyond what is stated would explain the outlines
// better than chance does once in 50 times: too little to tell, enough for a closer look.
bool may_be_misplaced(const OutlineDiagnosis& diagnosis, std::size_t body);

struct OutlineOptions {
  double place_std_mm = 0;  // of every body, in each coordinate
  double turn_std_rad = 0;  // of every body, about each axis
  double scale_relative_std = 0;
  double growth_std_px = 0;  // of the outline, outwards, besides the look's own error
};

// Least squares of all offsets. Besides the causes, the model has the errors of a quick look: the
// contour lies up to half a cell (standard deviation) farther out or in, and each shot's contour is
// shifted by 0.3 cells and each body's bent by as much, since the brighter side of a translucent
// body has another edge. The scatter
// of the points is that of a fit of all causes at once, and neighbours are taken as correlated over
// four points. Bodies: their names and centres (world, mm), by index. Precondition: at least ten
// offsets in all.
OutlineDiagnosis explain_outlines(const std::vector<OutlineShot>& shots,
                                  const CameraIntrinsics& intrinsics, const PoseResult& pose,
                                  const std::vector<std::string>& names,
                                  const std::vector<Eigen::Vector3d>& centers_mm,
                                  const OutlineOptions& options = {});

}  // namespace scattermeter::calib
