// A calibration board before the camera, as light on the sensor.
#pragma once

#include <vector>

#include "calib/board/calibration_board.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {

// Light per pixel of the whole frame, row by row, 1 for white in full light: white 1, black 0.045,
// a white margin of one square around the print, grey 0.25 beyond it or where the lens shows
// nothing; the light falls by 15 % from the board's left to its right. Each pixel is the mean over
// its area (8 x 8 points where it holds an edge: edges are placed to 0.005 px rms), then blurred by
// a Gaussian of blur_px (standard deviation). The board lies in the world's plane z = 0, its origin
// in the world's. The same digits for any number of threads.
std::vector<float> board_signal(const CameraView& view, const calib::CalibrationBoard& board,
                                double blur_px = 0.5);

}  // namespace scattermeter::apps
