// A camera with its pose, and the part of its frame that an object fills.
#pragma once

#include "core/camera/camera_model.h"
#include "core/camera/rigid3d.h"
#include "core/mesh/triangle_mesh.h"
#include "core/view/sample_map.h"

namespace scattermeter {

struct CameraView {
  CameraIntrinsics intrinsics;
  Rigid3d camera_from_world;

  Eigen::Vector3d center_in_world_mm() const { return inverse(camera_from_world).translation_mm; }
};

// Position of an object relative to the frame.
struct ViewCheck {
  bool in_front = false;  // every vertex has positive depth
  bool in_frame = false;  // at least part of its bounds falls on the frame
};
ViewCheck check_view(const CameraView& view, const TriangleMesh& mesh);

// Rays of the smallest rectangle of whole 2 x 2 cells that contains the projected vertices and a
// margin of `margin_px`, clipped to the frame. Precondition: both members of check_view() are true.
RayGrid rays_around(const CameraView& view, const TriangleMesh& mesh, int margin_px);

// Pose of a camera at `position_mm` that looks at `target_mm`, with the top of the image towards
// `up`.
Rigid3d look_at(const Eigen::Vector3d& position_mm, const Eigen::Vector3d& target_mm,
                const Eigen::Vector3d& up);

}  // namespace scattermeter
