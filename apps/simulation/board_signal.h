// A simulated shot of a calibration board, as light on the sensor.
#pragma once

#include <vector>

#include "calib/board/calibration_board.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {

// Light per pixel of the whole frame, row by row, relative to white in full light: white 1, black
// 0.045, a white margin of one square around the print, and 0.25 beyond it and outside the domain
// of the lens. The light decreases by 15 % from the left to the right of the board. Each pixel is
// the mean over its area (8 x 8 points if it contains an edge, which is then located to 0.005 px
// rms), blurred by a Gaussian with a standard deviation of blur_px. The board is in the world's
// plane z = 0 with its origin in the world's. The digits do not depend on the number of threads.
std::vector<float> board_signal(const CameraView& view, const calib::CalibrationBoard& board,
                                double blur_px = 0.5);

}  // namespace scattermeter::apps
