// A piece that is somewhat larger or smaller than its mesh.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/looks/finding.h"
#include "apps/rig/rig.h"
#include "capture/shots/shot_source.h"
#include "core/camera/camera_pose.h"
#include "core/scene/object_scene.h"

namespace scattermeter::apps {

// How the quick look sees the size of a piece, px.
struct SizeLook {
  double growth_px = 0;    // of the contour, outwards from the mesh's; good to a sixth of a cell
  double cell_px = 0;      // of the look
  double edge_cut_px = 0;  // a standard deviation by which its edges may be cut back
  double size_px = 0;      // of the mesh in the picture
};

SizeLook size_look(double growth_px, double cell_px, const Rig& rig, const ObjectScene& object,
                   const PoseResult& pose);

// Whether that asks for a closer look: edges cut back let a piece seem smaller, but never larger.
bool seems_scaled(const SizeLook& seen);

// What a contour farther in leaves open of the piece's size, where its edges may be cut back as
// well: half of the size that would explain it, relative; 0 within the look's own error.
double size_left_open(const SizeLook& seen);
// The note on that.
std::string size_note(const std::string& piece, const SizeLook& seen);

// The finding that a piece is larger or smaller than its mesh by more than the largest
// scale_relative_std of the rig's objects explains (p below 10^-4), by the careful search in two of
// its shots. The piece may stand anywhere within place_std_mm of its place (each coordinate), and
// turned by as much at a distance of its size. Absent where that does not show. shots: indices into
// the scene's, all of this object.
std::optional<Finding> scaled_piece(const Rig& rig, const ObjectScenes& objects,
                                    const SceneObject& piece, double place_std_mm,
                                    const PoseResult& pose, const capture::FrameSource& frames,
                                    const std::vector<std::size_t>& shots);

}  // namespace scattermeter::apps
