// Lens parameters that a calibration fits, and the derivatives of the image by them.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/camera/camera_model.h"

namespace scattermeter {

class Lens;

inline constexpr int kLensParameters = 12;
// fx_px fy_px cx_px cy_px k1 k2 p1 p2 k3 k4 k5 k6 (core/camera/distortion.h).
using LensParameters = Eigen::Matrix<double, kLensParameters, 1>;

LensParameters lens_parameters(const CameraIntrinsics& intrinsics);
// With five distortion terms (zero where absent), or eight where k4, k5 or k6 is not zero.
CameraIntrinsics intrinsics_of(const LensParameters& lens, int width_px, int height_px);

// d(pixel)/d(parameter) of the ray (X / Z, Y / Z), 2 x 12; px per px for the first four, px per
// unit for the others. Precondition: in the domain of Distortion.
Eigen::Matrix<double, 2, kLensParameters> shift_per_lens_parameter(const LensParameters& lens,
                                                                   const Eigen::Vector2d& ray);

// d(ray)/d(parameter) of the ray (X / Z, Y / Z) through a fixed pixel:
// J_ray d(ray) + shift_per_lens_parameter() d(parameter) = 0. Units as there. NaN outside the
// domain of Distortion.
Eigen::Matrix<double, 2, kLensParameters> ray_per_lens_parameter(const CameraIntrinsics& intrinsics,
                                                                 const Eigen::Vector2d& ray);
// The same for many rays through one lens, of these parameters.
Eigen::Matrix<double, 2, kLensParameters> ray_per_lens_parameter(const Lens& lens,
                                                                 const LensParameters& parameters,
                                                                 const Eigen::Vector2d& ray);

// Each value includes all terms of the preceding ones.
enum class DistortionTerms { kNone, kK1, kK1K2, kK1K2P1P2, kK1K2P1P2K3, kRational };

// Which of the twelve parameters are fitted; the others are 0, and fy = fx with one focal length.
// The principal point is always fitted.
struct LensModel {
  bool one_focal_length = true;
  DistortionTerms terms = DistortionTerms::kK1K2;
  bool operator==(const LensModel&) const = default;
};

// All twelve models, those with fewer parameters first.
std::vector<LensModel> all_lens_models();
std::string lens_model_name(const LensModel& model);  // "fx = fy, k1 k2"

// Of the fitted parameters: f_px or fx_px fy_px, cx_px, cy_px, k1 ...
std::vector<std::string> parameter_names(const LensModel& model);
// 12 x P of zeros and ones: lens = map * fitted.
Eigen::MatrixXd parameter_map(const LensModel& model);

// The model with exactly these parameters; std::invalid_argument if there is none.
LensModel lens_model_of(const std::vector<std::string>& names);

// Square root of the covariance of the lens parameters, covariance = root root^T: one column for
// each independent unit error. No columns: the lens is taken as exact.
using LensRoot = Eigen::Matrix<double, kLensParameters, Eigen::Dynamic>;

// From the covariance of the fitted parameters with these names, in their units. No columns if it
// is zero or there are no parameters. std::invalid_argument for names that no model has.
LensRoot lens_root(const std::vector<std::string>& parameters, const Eigen::MatrixXd& covariance);

// Independent standard deviations of a lens that no calibration describes: of both focal lengths
// together, of their ratio, of each coordinate of the principal point, px, and of k1.
struct LensDeviations {
  double focal_length_relative = 0;
  double aspect_relative = 0;
  double centre_px = 0;
  double k1 = 0;
};
// No columns for what is exact (0). std::invalid_argument for a negative deviation.
LensRoot lens_root(const CameraIntrinsics& intrinsics, const LensDeviations& deviations);

}  // namespace scattermeter
