// A lit ChArUco board in a synthetic shot.
#pragma once

#include <array>
#include <vector>

#include "calib/board/charuco_board.h"
#include "core/light/led.h"
#include "core/mesh/ray_scene.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {

// Radiance of the board per channel, W/(mm^2 sr), wherever a pixel's ray meets it: a white diffuser
// of reflectance 0.9 with black of 0.04, lit by the LEDs (as points), in the object's shadow
// where that falls on it, and by an irradiance that is the same all over it (that of environments,
// without the object's shadow). Adds to a picture of the whole frame (height * width, one Array3d a
// pixel is never stored: only the pixel's own channel). Light between board and object is left out.
void add_board(const CameraView& view, const calib::CharucoBoard& board,
               const std::vector<Led>& leds, const Eigen::Array3d& ambient_W_per_mm2,
               const RayScene& object, const std::array<int, 4>& channel_of_phase,
               std::vector<float>& radiance);

}  // namespace scattermeter::apps
