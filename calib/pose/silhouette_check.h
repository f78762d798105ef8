// Does the objects' outline in the shots lie where pose, meshes and lens say? If not: why.
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

// The outline of one shot against the pose that was stated.
struct SilhouetteShot {
  std::string file;
  std::string object;
  bool found = false;
  std::string problem;  // why not
  std::size_t pieces = 0;
  std::size_t pieces_left_out = 0;
  double rms_px = 0;    // found - predicted, at right angles to the edge
  double worst_px = 0;  // the largest of them
  // Mean shift of the whole outline, right and down, and its standard deviation (of the shot alone:
  // without that of the pose).
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d shift_std_px = Eigen::Vector2d::Zero();
  std::vector<EdgePoint> points;  // for pictures; offset_px against the stated pose
};

struct SilhouetteCheck {
  std::vector<SilhouetteShot> shots;
  std::size_t shots_found = 0;
  double rms_px = 0;  // over all pieces of all shots
  double worst_px = 0;
  EdgeDiagnosis diagnosis;  // over all shots; meaningless where shots_found is 0
  // Between shots of the same object, which share what is wrong with mesh and lens.
  bool drifts = false;        // p below 1e-4 that the camera stood still
  std::string drift_verdict;  // "camera moved by 0.41 +- 0.03 px before PE_cube_2.dng", or ""
  double drift_px = 0;        // largest shift of a shot from the first of its object
  double drift_std_px = 0;

  bool passed() const { return shots_found > 0 && diagnosis.agrees && !drifts; }
  // One line: what is wrong and by how much, or that nothing is.
  std::string verdict() const;
};

struct SilhouetteCheckOptions {
  SilhouetteOptions silhouette;
  EdgeExplanationOptions explanation;
};

// Opens every shot of the source once more. `stated`: the pose of the rig's points. Shots whose
// outline is not found say so and are left out. Throws InputError for what cannot be read.
SilhouetteCheck check_silhouettes(const Scene& scene, const PoseSource& source,
                                  const ObjectScenes& objects, const capture::FrameSource& frames,
                                  const std::vector<std::size_t>& shot_idxs,
                                  const PoseResult& stated,
                                  const SilhouetteCheckOptions& options = {});

// Shots that stand each for itself, with a pose of its own (by a board in the shot): outlines and
// their diagnosis one by one. The diagnosis of the answer is that of the first shot that
// contradicts the rig, its verdict naming the file; nothing drifts. Edges before the board's paper
// are left out (calib/board/board_mask.h). Precondition (std::invalid_argument): as many poses as
// shots.
SilhouetteCheck check_silhouettes_apart(const Scene& scene, const PoseSource& source,
                                        const ObjectScenes& objects,
                                        const capture::FrameSource& frames,
                                        const std::vector<std::size_t>& shot_idxs,
                                        const std::vector<PoseResult>& stated,
                                        const SilhouetteCheckOptions& options = {});

// The part of a frame that the search needs, ready for it. body_idx: place among the rig's objects.
EdgeShot edge_shot(const Scene& scene, const PoseSource& source, const ObjectScenes& objects,
                   const SceneShot& shot, const capture::RawFrame& frame,
                   const Rigid3d& camera_from_world, const SilhouetteOptions& options);

}  // namespace scattermeter::calib
