// ChArUco boards: the printed pattern and the detection of its corners in a shot.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/camera/camera_pose.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// Board frame: origin at the board's lower left outer corner as seen from the printed side, x along
// squares_x, y along squares_y, z out of the printed side (so right-handed with the print facing
// +z). `world_from_board` is the board's pose in the world.
//
// The pattern is that of OpenCV 4.6 and later (CharucoBoard::draw; in 4.7+ without
// setLegacyPattern): the upper left square is black, markers count from the upper left, row by row.
// OpenCV's own board frame has its origin at the upper left, y down and z into the print.
struct CharucoBoard {
  int squares_x = 0;  // at least 3, so that there are four inner corners
  int squares_y = 0;  // at least 3
  double square_mm = 0;
  double marker_mm = 0;                    // smaller than square_mm
  std::string dictionary = "DICT_4X4_50";  // OpenCV's predefined name
  Rigid3d world_from_board;
};

// What is wrong with the numbers (sizes, an unknown dictionary, too few markers in it, a pose that
// is not finite), or "". The functions below throw std::invalid_argument with this text if it is
// not empty.
std::string board_problem(const CharucoBoard& board);

// The printed pattern: reflectance 0 or 1 at a position on the board in mm (board frame), exact to
// rounding. Outside the board: NaN.
class CharucoPattern {
 public:
  explicit CharucoPattern(const CharucoBoard& board);
  double reflectance(double x_mm, double y_mm) const;
  // Along a side of a marker, its black border included.
  int cells() const { return cells_; }

 private:
  int squares_x_;
  int squares_y_;
  double square_mm_;
  double marker_mm_;
  int cells_;
  std::vector<int> marker_id_;      // per square from the upper left, row by row; -1: black, none
  std::vector<unsigned char> bit_;  // cells x cells per id, from the upper left, row by row
};

// Chessboard corners found in a single-channel image (row by row, any scale, linear in radiance;
// values that are not finite count as dark), with their world positions. They are refined to
// sub-pixel accuracy on the image as given, not on an 8-bit copy. `px_scale` and `px_offset` map
// the image's pixel coordinates to the sensor's: sensor_px = px_scale * image_px + px_offset (for
// an image that was binned 2 x 2 from the CFA: 2 and 0.5). Corners that are hidden or out of the
// frame are omitted; the list is empty when the board is not detected. A corner may be wrong:
// estimate_pose() rejects such outliers. Throws std::invalid_argument if the image does not have
// width_px * height_px samples or px_scale is not positive and finite.
std::vector<PointPair> find_charuco_corners(const CharucoBoard& board,
                                            const std::vector<float>& image, int width_px,
                                            int height_px, double px_scale, double px_offset);

}  // namespace scattermeter::calib
