// A lens from views of a flat board.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "calib/lens/camera_layout.h"
#include "calib/lens/lens_choice.h"
#include "calib/lens/view_selection.h"
#include "core/camera/camera_model.h"

namespace scattermeter::calib {

struct CameraCalibrationOptions {
  double board_std_mm = 0;         // of each coordinate of a printed corner, alike in all views
  std::optional<LensModel> model;  // absent: chosen by cross-validation
  void Check() const;              // std::invalid_argument naming the field
};

// Each status by its condition, in the order in which they are looked for.
enum class CameraCalibrationStatus {
  kOk,
  // Fewer than three views can be used.
  kTooFewViews,
  // Their corners agree with no camera (ViewSelection::fault).
  kNoConsensus,
  // No lens model settles, or the focal length is uncertain by more than 2 %.
  kNotDetermined,
};

struct CalibratedView {
  std::string name;
  std::size_t n_corners = 0;
  double rms_px = 0;
  double worst_px = 0;
};

struct CornerResidual {
  std::size_t view_idx = 0;  // of CameraCalibration::views
  Eigen::Vector2d image_px;
  Eigen::Vector2d residual_px;  // projected - found
};

// Everything after `message` is meant where status is kOk only, but for what was left out.
struct CameraCalibration {
  CameraCalibrationStatus status = CameraCalibrationStatus::kTooFewViews;
  std::string message;  // why it is refused and what to do; "" if ok
  CameraIntrinsics intrinsics;
  LensModel model;
  // Of the fitted numbers (parameter_names()) and their covariance in these units. What was not
  // fitted is 0, or equal to f_px. The estimate's error of one calibration; the lens may move.
  std::vector<std::string> parameters;
  Eigen::MatrixXd covariance;
  double rms_px = 0;  // over the corners used, of the 2-vector's length
  double worst_px = 0;
  double noise_std_px = 0;  // per coordinate, on which the covariance stands
  // LensUncertainty: how much more the views differ than independent corner errors would let them,
  // in variance, and whether the covariance was multiplied by it.
  double view_scatter = 1;
  bool widened = false;
  // Largest standard deviation of the image of a fixed ray, px, over the frame's four corners.
  double frame_corner_std_px = 0;
  std::vector<CalibratedView> views;  // used ones
  std::vector<CornerResidual> residuals;
  std::vector<LeftOutView> left_out;
  std::vector<LeftOutCorner> corners_left_out;
  std::vector<LensCandidate> candidates;
  std::size_t chosen = 0;
  CameraLayout layout;
  std::vector<std::string> warnings;

  double value(std::size_t parameter_idx) const;
  double std(std::size_t parameter_idx) const;
};

// Shift of the image of the ray that now falls on `pixel`, per unit of each of `parameters`
// (parameter_names()): 2 x P, px per px or per unit. NaN where the pixel has no ray.
Eigen::MatrixXd image_shift_per_parameter(const CameraIntrinsics& intrinsics,
                                          const std::vector<std::string>& parameters,
                                          const Eigen::Vector2d& pixel);

// Selects views and corners (view_selection.h), chooses the model (lens_choice.h), then leaves out
// views, worst first, that pull the lens off more than their corner errors can: their part of
// LensUncertainty::view_scatter beyond 15 times the median view's (a picture of another camera or
// focus can fit by itself; views at least six, at most a quarter of them). Deterministic, the same
// digits for any number of threads. Bad layouts are a status. std::invalid_argument for sizes
// that are not positive, options out of range, coordinates that are not finite, or names of views
// that repeat.
CameraCalibration calibrate_camera(const std::vector<BoardView>& views, int width_px, int height_px,
                                   const CameraCalibrationOptions& options = {});

}  // namespace scattermeter::calib
