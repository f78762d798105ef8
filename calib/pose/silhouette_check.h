// Check of the objects' outlines in the shots against pose, meshes and lens, with a diagnosis of
// departures.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "calib/pose/edge_explanations.h"
#include "calib/pose/pose.h"
#include "calib/pose/pose_source.h"
#include "calib/pose/silhouette.h"
#include "capture/raw/raw_frame.h"
#include "capture/shots/shot_source.h"
#include "core/scene/object_scene.h"
#include "core/scene/scene.h"

namespace scattermeter::calib {

// The outline in one shot compared with the stated pose.
struct SilhouetteShot {
  std::string file;
  std::string object;
  bool found = false;
  std::string problem;  // why not
  std::size_t pieces = 0;
  std::size_t pieces_left_out = 0;
  double rms_px = 0;    // measured - predicted, normal to the edge
  double worst_px = 0;  // the largest
  // Mean shift of the whole outline, right and down, and its standard deviation (from the shot
  // alone, without that of the pose).
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d shift_std_px = Eigen::Vector2d::Zero();
  std::vector<EdgePoint> points;  // for pictures; offset_px relative to the stated pose
};

struct SilhouetteCheck {
  std::vector<SilhouetteShot> shots;
  std::size_t shots_found = 0;
  double rms_px = 0;  // over all pieces of all shots
  double worst_px = 0;
  EdgeDiagnosis diagnosis;  // over all shots; meaningless where shots_found is 0
  // Drift between shots of the same object, which have the errors of mesh and lens in common.
  bool drifts = false;        // p below 1e-4 for a camera at rest
  std::string drift_verdict;  // "camera moved by 0.41 +- 0.03 px before PE_cube_2.dng", or ""
  double drift_px = 0;        // largest shift of a shot relative to the first of its object
  double drift_std_px = 0;

  bool passed() const { return shots_found > 0 && diagnosis.agrees && !drifts; }
  // One line: what is wrong and by how much, or that the outlines agree.
  std::string verdict() const;
};

struct SilhouetteCheckOptions {
  SilhouetteOptions silhouette;
  EdgeExplanationOptions explanation;
};

// Checks all given shots with one pose of the camera. `stated`: the pose from the points of the
// rig. A shot whose outline is not found is reported as such and left out. Throws InputError for a
// shot that cannot be read.
SilhouetteCheck check_silhouettes(const Scene& scene, const PoseSource& source,
                                  const ObjectScenes& objects, const capture::FrameSource& frames,
                                  const std::vector<std::size_t>& shot_idxs,
                                  const PoseResult& stated,
                                  const SilhouetteCheckOptions& options = {});

// Checks each shot separately with its own pose (from a board in the shot). The diagnosis returned
// is that of the first shot that contradicts the rig, with a verdict that names the file; drift is
// not checked. Edges in front of the board's paper are left out (calib/board/board_mask.h). Throws
// std::invalid_argument unless there are as many poses as shots.
SilhouetteCheck check_silhouettes_apart(const Scene& scene, const PoseSource& source,
                                        const ObjectScenes& objects,
                                        const capture::FrameSource& frames,
                                        const std::vector<std::size_t>& shot_idxs,
                                        const std::vector<PoseResult>& stated,
                                        const SilhouetteCheckOptions& options = {});

// The part of a frame that the search needs, with body_idx an index into the objects of the rig.
EdgeShot edge_shot(const Scene& scene, const PoseSource& source, const ObjectScenes& objects,
                   const SceneShot& shot, const capture::RawFrame& frame,
                   const Rigid3d& camera_from_world, const SilhouetteOptions& options);

}  // namespace scattermeter::calib
