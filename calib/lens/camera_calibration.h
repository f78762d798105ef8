// Calibration of a lens from views of a flat board.
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
  double board_std_mm = 0;         // of each coordinate of a printed corner, common to all views
  std::optional<LensModel> model;  // absent: chosen by cross-validation
  void Check() const;              // std::invalid_argument naming the field
};

// Each status with its condition, in the order in which they are checked.
enum class CameraCalibrationStatus {
  kOk,
  // Fewer than three views can be used.
  kTooFewViews,
  // The corners are not consistent with any camera (ViewSelection::fault).
  kNoConsensus,
  // The fit of no lens model converges, or the focal length is uncertain by more than 2 %.
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

// Members after `message`, except for the lists of what was left out, are valid only if the status
// is kOk.
struct CameraCalibration {
  CameraCalibrationStatus status = CameraCalibrationStatus::kTooFewViews;
  std::string message;  // why it was refused and what to do; "" if ok
  CameraIntrinsics intrinsics;
  LensModel model;
  // The fitted parameters (parameter_names()) and their covariance in the same units. A parameter
  // that was not fitted is 0, or equal to f_px. The covariance describes the error of one
  // calibration; the lens itself may move afterwards.
  std::vector<std::string> parameters;
  Eigen::MatrixXd covariance;
  double rms_px = 0;  // over the corners used, length of the 2-vector
  double worst_px = 0;
  double noise_std_px = 0;  // per coordinate; the covariance is based on it
  // From LensUncertainty: the factor in variance by which the views differ more than independent
  // corner errors explain, and whether the covariance was multiplied by it.
  double view_scatter = 1;
  bool widened = false;
  // Largest standard deviation of the image of a fixed ray, px, over the frame's four corners.
  double frame_corner_std_px = 0;
  std::vector<CalibratedView> views;  // those used
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
// (parameter_names()): 2 x P, px per px or per unit. NaN if the pixel has no ray.
Eigen::MatrixXd image_shift_per_parameter(const CameraIntrinsics& intrinsics,
                                          const std::vector<std::string>& parameters,
                                          const Eigen::Vector2d& pixel);

// Selects views and corners (view_selection.h), chooses the model (lens_choice.h), then leaves out,
// worst first, views that change the lens by more than their corner errors can explain: those whose
// part of LensUncertainty::view_scatter exceeds 15 times that of the median view (a picture with
// another camera or focus can fit by itself). This needs at least six views and removes at most a
// quarter of them. Deterministic, with the same digits for any number of threads. An unsuitable
// layout is reported by the status. Throws std::invalid_argument for sizes that are not positive,
// options out of range, coordinates that are not finite, or repeated names of views.
CameraCalibration calibrate_camera(const std::vector<BoardView>& views, int width_px, int height_px,
                                   const CameraCalibrationOptions& options = {});

}  // namespace scattermeter::calib
