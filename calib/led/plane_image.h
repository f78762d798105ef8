// The position of the image of a white plane in a frame.
#pragma once

#include "calib/led/white_plane.h"
#include "core/camera/camera_model.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// Rectangle (even x0, y0; clipped to the frame) that contains the image of the plane; width 0 if it
// is out of view or seen from behind.
struct PlaneImage {
  int x0 = 0, y0 = 0, width = 0, height = 0;  // px
  double mm_per_px = 0;                       // on the plane, the largest of its corners
};
PlaneImage plane_image(const CameraIntrinsics& intrinsics, const Rigid3d& camera_from_world,
                       const WhitePlane& plane);

}  // namespace scattermeter::calib
