// CharucoBoard as OpenCV's aruco module knows it. For calib's own .cc files only: unlike all other
// headers it shows OpenCV's types.
#pragma once

#include <opencv2/aruco/charuco.hpp>

#include "calib/board/charuco_board.h"

namespace scattermeter::calib {

// std::invalid_argument with board_problem() where that is not empty. In mm, OpenCV's board frame.
cv::Ptr<cv::aruco::CharucoBoard> opencv_board(const CharucoBoard& board);

}  // namespace scattermeter::calib
