// A lit ChArUco board in a synthetic shot.
#pragma once

#include <vector>

#include "calib/board/charuco_board.h"
#include "core/camera/cfa_pattern.h"
#include "core/light/led.h"
#include "core/mesh/ray_scene.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {

// Adds the radiance of the board, W/(mm^2 sr), to a picture of the whole frame in which each pixel
// holds the channel of its own filter. The board is a diffuser of reflectance 0.9 (white) and 0.04
// (black), lit by the LEDs (as points, with the object's shadow) and by a uniform irradiance (that
// of environments, without the object's shadow). Light between board and object is left out.
void add_board(const CameraView& view, const calib::CharucoBoard& board,
               const std::vector<Led>& leds, const Eigen::Array3d& ambient_W_per_mm2,
               const RayScene& object, const CfaPattern& cfa, std::vector<float>& radiance);

}  // namespace scattermeter::apps
