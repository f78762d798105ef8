// What a rig leaves open of the outlines of its objects, and the careful search of outlines, where
// the quick look found something.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/rig/rig.h"
#include "calib/pose/outline_causes.h"
#include "calib/pose/silhouette_check.h"
#include "capture/shots/shot_source.h"
#include "core/camera/camera_pose.h"
#include "core/scene/object_scene.h"

namespace scattermeter::apps {

// Pixels of the picture to a length at the object.
double px_per_mm(const CameraIntrinsics& intrinsics, const ObjectScene& object,
                 const PoseResult& pose);

// How far the object's outline may lie farther in than that of its mesh, px: its edges may be cut
// back by edge_std_mm, of which the outline of a bevel seen from any side shows some 0.7.
double edge_cut_px(const CameraIntrinsics& intrinsics, const ObjectScene& object,
                   const PoseResult& pose);

// Standard deviation of an object's position in each coordinate, mm: at least 0.1, also of one
// stated as exact, as a quick look is no better.
double quick_place_std_mm(const ObjectScene& object);

// The largest deviations of the objects in `objects`, in each quantity.
calib::OutlineOptions outline_options(const Rig& rig, const ObjectScenes& objects,
                                      const PoseResult& pose);

// The careful search of the outlines of these shots (of four, if there are more), with the sizes of
// the meshes as uncertain as the rig states. line_std_px: SilhouetteOptions.
calib::SilhouetteCheck careful_search(const Rig& rig, const ObjectScenes& objects,
                                      const PoseResult& pose, const capture::FrameSource& frames,
                                      std::vector<std::size_t> shots, double line_std_px);

// Whether the careful search finds the outline in all of these shots (in four, if there are more)
// where the rig puts it. The quick look may take the dark side of a body for background.
bool closer_look_agrees(const Rig& rig, const ObjectScenes& objects, const PoseResult& pose,
                        const capture::FrameSource& frames, const std::vector<std::size_t>& shots);

// The largest deviation that an object states of its lengths.
double mesh_scale_std(const Scene& scene);

// "2.8 px right and 0.1 px high".
std::string shift_phrase(const Eigen::Vector2d& shift_px);

// By how much the careful search finds the outlines of these shots (of four, if there are more)
// away from where the rig puts them, as a reason with the next step: shifted, or of another shape;
// "" within 1 px or one and a half standard deviations, or where an outline is not found.
std::string outline_departure(const Rig& rig, const ObjectScenes& objects, const PoseResult& pose,
                              const capture::FrameSource& frames,
                              const std::vector<std::size_t>& shots);

}  // namespace scattermeter::apps
