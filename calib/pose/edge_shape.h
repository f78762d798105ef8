// Profile of an edge across a pixel grid: powers of the distance, blurred and averaged over a
// pixel.
#pragma once

#include <array>

#include <Eigen/Core>

namespace scattermeter::calib {

inline constexpr int kEdgeTerms = 3;  // S_0, S_1, S_2

// S_k(t) is t^k for t > 0 and 0 otherwise, after a Gaussian blur and averaging over the square of a
// pixel, both without approximation. With F_0 = Phi(t / blur), k F_k = t F_k-1 + blur^2 F_k-2 (F_-1
// the Gaussian's density; repeated integrals of the normal distribution, Abramowitz and Stegun
// 7.2), the mean over the square is a second difference of k! F_k+2 over its widths |n_x|, |n_y|
// along the unit normal of the edge, each taken as at least 1e-3.
class EdgeShape {
 public:
  EdgeShape(const Eigen::Vector2d& normal, double blur_px);  // blur_px > 0

  // S_0, S_1, S_2 at t px, unit px^k, and their derivatives by t and by the blur (as of heat: by
  // the square of the blur, half the second by t).
  struct Terms {
    std::array<double, kEdgeTerms> s, per_t, per_blur;
  };
  Terms at(double t) const;

 private:
  std::array<double, 5> integrals(double t) const;  // F_0 ... F_4

  double a_;
  double b_;
  double blur_;
};

}  // namespace scattermeter::calib
