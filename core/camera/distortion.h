// Brown-Conrady lens distortion with OpenCV's rational radial term, and its inverse.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace scattermeter {

// Maps the undistorted normalised image point x = (X / Z, Y / Z) to the distorted one. With
// s = x^2 + y^2 and
//   c(s) = (1 + k1 s + k2 s^2 + k3 s^3) / (1 + k4 s + k5 s^2 + k6 s^3)
// it is (OpenCV 4.6, calib3d, "Detailed Description"; D. C. Brown, "Decentering distortion of
// lenses", 1966, for the tangential part)
//   x_d = x c + 2 p1 x y + p2 (s + 2 x^2)
//   y_d = y c + p1 (s + 2 y^2) + 2 p2 x y.
//
// Domain: a polynomial that fits a lens inside the frame folds back outside of it: from some radius
// on, points farther from the axis are mapped closer to it, on top of the image of others. The
// domain ends there, at the smallest radius where d(r c)/dr <= 0 or the denominator is <= 0, and at
// the latest 87 degrees off the axis (r = 20). Without distortion it is unbounded.
class Distortion {
 public:
  // k1 k2 p1 p2 [k3 [k4 k5 k6]]: 0, 4, 5 or 8 finite terms, else std::invalid_argument.
  explicit Distortion(const std::vector<double>& terms);

  bool is_identity() const { return identity_; }
  // Radius at which the domain ends; infinite where there is no distortion.
  double domain_radius() const { return domain_radius_; }

  // The distorted point; with its 2 x 2 Jacobian d(distorted)/d(undistorted) if `jacobian` is
  // given. Both NaN outside the domain.
  Eigen::Vector2d apply(const Eigen::Vector2d& undistorted,
                        Eigen::Matrix2d* jacobian = nullptr) const;

  // The point of the domain that apply() maps within `tolerance` of `distorted`, by damped Newton
  // steps from `guess`, then from the radial inverse if those fail. NaN where there is none.
  //
  // Not cv::undistortPoints: its fixed-point iteration contracts by 2 s |c'| / c only, so to 1e-9
  // px it takes three times as long over a frame with mild distortion, seven with strong barrel; it
  // diverges where that ratio passes 1 (pincushion k1 = 0.5 beyond r = 1.41); and it cannot detect
  // where the inverse ends.
  Eigen::Vector2d invert(const Eigen::Vector2d& distorted, const Eigen::Vector2d& guess,
                         double tolerance) const;

 private:
  // c(s) and dc/ds.
  double radial_factor(double s, double* derivative) const;
  double find_domain_radius() const;
  // Undistorted point in the same direction, ignoring the tangential part.
  Eigen::Vector2d invert_radial(const Eigen::Vector2d& distorted) const;
  Eigen::Vector2d newton(const Eigen::Vector2d& distorted, Eigen::Vector2d x,
                         double tolerance) const;

  double k_[6] = {0, 0, 0, 0, 0, 0};
  double p1_ = 0;
  double p2_ = 0;
  bool identity_ = true;
  double domain_radius_ = 0;
};

}  // namespace scattermeter
