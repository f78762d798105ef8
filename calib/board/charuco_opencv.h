// Conversion of a CharucoBoard to the type of OpenCV's aruco module. For the .cc files of calib
// only, as it exposes OpenCV's types.
#pragma once

#include <opencv2/aruco/charuco.hpp>

#include "calib/board/charuco_board.h"

namespace scattermeter::calib {

// The board in mm and in OpenCV's board frame. Throws std::invalid_argument with the text of
// board_problem() if that is not empty.
cv::Ptr<cv::aruco::CharucoBoard> opencv_board(const CharucoBoard& board);

}  // namespace scattermeter::calib
