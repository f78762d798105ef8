// A piece that is somewhat larger or smaller than its mesh.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "apps/instrument/finding.h"
#include "apps/rig/rig.h"
#include "capture/shots/shot_source.h"
#include "core/camera/camera_pose.h"
#include "core/scene/object_scene.h"

namespace scattermeter::apps {

// Whether a contour that the quick look sees so much farther out than the mesh's, px, asks for a
// closer look. That look is good to a sixth of a cell, and edges cut back (edge_cut_px(), a
// standard deviation) let a piece seem smaller, but never larger.
bool seems_scaled(double growth_px, double cell_px, double edge_cut_px);

// The finding that a piece is larger or smaller than its mesh by more than its scale_relative_std
// explains (p below 10^-4), by the careful search in two of its shots. The piece may stand anywhere
// within place_std_mm of its place (each coordinate), and turned by as much at a distance of its
// size. Absent where that does not show. shots: indices into the scene's, all of this object.
std::optional<Finding> scaled_piece(const Rig& rig, const ObjectScenes& objects,
                                    const SceneObject& piece, double place_std_mm,
                                    const PoseResult& pose, const capture::FrameSource& frames,
                                    const std::vector<std::size_t>& shots);

}  // namespace scattermeter::apps
