// The lens that the pose points show, where they depart from the stated one.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "calib/pose/pose.h"
#include "calib/pose/pose_source.h"
#include "capture/shots/shot_source.h"
#include "core/camera/camera_model.h"
#include "core/camera/lens_parameters.h"
#include "core/scene/scene.h"

namespace scattermeter::calib {

// The most probable lens, given its prior and the points, and what they leave uncertain of it.
struct LensOfPoints {
  CameraIntrinsics intrinsics;
  LensRoot root;  // of its covariance, as many columns as the prior's
  // The lens in standard deviations of the prior, one for each column of its root.
  Eigen::VectorXd deviations;
  PoseResult pose;  // with this lens
  // That the inliers' residuals, over point_std_px, and the lens, in deviations, are so large by
  // chance.
  double p_value = 0;
};

// Fits pose and lens to the points together: residuals over point_std_px, and the lens over `root`,
// by Gauss and Newton's method, the pose solved for each lens. The status of `pose` says whether
// there is one. The p_value stays 0 where the lens would be ten deviations off,
// or none.
LensOfPoints lens_of_points(const CameraIntrinsics& stated, const LensRoot& root,
                            const std::vector<PointPair>& points, const PoseOptions& options);

// Takes the lens of the source's points, and what remains uncertain of it, for that of the scene
// where the points contradict the stated lens itself, but not what the scene states about it: the
// focal length of a lens that was focused again. Returns a note that says so; "" if nothing
// changes.
std::string take_lens_of_points(const PoseSource& source, Scene& scene);

// The same after take_points_from_board_shot() (calib/pose/shot_pose.h), which throws InputError.
std::string take_points_and_lens(Scene& scene, const capture::ShotDecoding& decoding,
                                 const std::string& shots_folder, PoseSource& source);

}  // namespace scattermeter::calib
