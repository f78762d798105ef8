// The data of one LED from calibration shots: views, highlights and shaded cells.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "calib/led/mirror_sphere.h"
#include "calib/led/white_plane.h"
#include "core/camera/camera_model.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// The camera pose of a shot. The covariance is that of PoseResult: (w in rad, dt in mm), camera
// axes.
struct LedView {
  Rigid3d camera_from_world;
  Eigen::Matrix<double, 6, 6> pose_covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

// The image of the LED in a mirror sphere.
struct SeenHighlight {
  std::size_t view = 0;    // index into LedScene::views
  std::size_t sphere = 0;  // index into LedScene::spheres
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();
  double std_px = 0;  // of each coordinate, > 0
};

// The mean of one channel's samples in a cell of a white plane.
struct ShadedCell {
  std::size_t view = 0;
  std::size_t plane = 0;
  std::size_t shot = 0;     // cells of a shot have the same ambient light
  std::size_t setting = 0;  // index into LedScene::exposure_relative_std
  int column = 0, row = 0;  // in the grid of cells of the plane
  int channel = 0;          // 0 R, 1 G, 2 B
  Eigen::Vector2d on_plane_mm = Eigen::Vector2d::Zero();  // mean of the samples, on the plane
  Eigen::Matrix2d spread_mm2 = Eigen::Matrix2d::Zero();   // covariance of their positions
  double radiance_W_per_mm2_sr = 0;
  double std_W_per_mm2_sr = 0;  // of the mean, from the noise of the samples; > 0
};

struct LedScene {
  CameraIntrinsics intrinsics;
  std::vector<LedView> views;
  std::vector<MirrorSphere> spheres;
  std::vector<WhitePlane> planes;
  std::vector<SeenHighlight> highlights;
  std::vector<ShadedCell> cells;
  // Relative standard deviation of the true time of each exposure setting, an error common to all
  // cells of that setting and equivalent to an error of the power. Empty: all times are exact.
  std::vector<double> exposure_relative_std;
  // Indexed by ShadedCell::shot: whether the ambient light of the shot was measured with the LED
  // off and subtracted from its cells. Empty: not in any shot.
  std::vector<bool> ambient_subtracted;

  std::size_t plane_shots() const;  // one more than the largest ShadedCell::shot; 0 without cells

  // World position of the mean of a cell's samples.
  Eigen::Vector3d cell_mm(const ShadedCell& cell) const;

  // World position of the centre of the data in use: the mean of the cells in use or, without any,
  // of the spheres whose highlights are in use (a sphere counts once per highlight). One flag per
  // cell and per highlight; NaN if none is set.
  Eigen::Vector3d data_center_mm(const std::vector<bool>& use_cell,
                                 const std::vector<bool>& use_highlight) const;
};

}  // namespace scattermeter::calib
