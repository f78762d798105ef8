// Pinhole camera with lens distortion.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/camera/rigid3d.h"

namespace scattermeter {

// OpenCV's model and axes: x right, y down, z forward; pixel (0, 0) is the centre of the first
// sample of the active area. distortion: k1 k2 p1 p2 [k3 [k4 k5 k6]] (0, 4, 5 or 8 terms),
// dimensionless; formula and domain in core/camera/distortion.h.
struct CameraIntrinsics {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;
  double cy_px = 0;
  std::vector<double> distortion;
};

// The first violated condition, or an empty string: sizes and focal lengths positive and finite,
// centre finite and within half a frame of the frame, an allowed number of distortion terms, all
// finite. The functions below throw std::invalid_argument with this text where it is not empty.
std::string intrinsics_problem(const CameraIntrinsics& intrinsics);

// Images of world points, in px, inside or outside the frame. NaN for points with depth <= 0 in
// the camera frame, and for points so far off the axis that the distortion's polynomial folds back
// (which would put them on top of others): they have no image. A NaN point gives NaN.
std::vector<Eigen::Vector2d> project(const CameraIntrinsics& intrinsics,
                                     const Rigid3d& camera_from_world,
                                     const std::vector<Eigen::Vector3d>& points_in_world_mm);

// (X / Z, Y / Z) in the camera frame of the rays through image points: the inverse of project(),
// which returns to the point within 1e-6 px. NaN where the distortion has no inverse.
std::vector<Eigen::Vector2d> undistort(const CameraIntrinsics& intrinsics,
                                       const std::vector<Eigen::Vector2d>& points_in_image_px);

// Directions (not normalised, z = 1, camera frame) of the rays through the pixel centres of the
// rectangle [x0, x0 + width) x [y0, y0 + height), row by row; it may reach beyond the frame.
// Distortion is undone to 1e-6 px or better, then rounded to float (a relative 6e-8: 1e-4 px at the
// corner of a 3872 x 2592 frame); where the model has no inverse the direction is NaN. Parallel;
// the same digits for any number of threads. width or height negative: std::invalid_argument.
std::vector<Eigen::Vector3f> pixel_rays_in_camera(const CameraIntrinsics& intrinsics, int x0,
                                                  int y0, int width, int height);

}  // namespace scattermeter
