// The radiance of a cell of a white plane under an LED as a function of the unknowns of the fit.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "calib/led/led_frame.h"
#include "calib/led/led_scene.h"

namespace scattermeter::calib {

//   L = albedo / pi * I * lobe(w) * cos / r^2,
// averaged over four points that have the spread of the cell and over the disc of the LED (four
// points on a ring of radius / sqrt 2, exact to second order). Keeps a reference to the frame.
class CellModel {
 public:
  CellModel(const LedFrame& frame, const ShadedCell& cell);

  // The radiance in W/(mm^2 sr) at the unknowns of LedFrame: nine of the LED, six of the view, and
  // one each for albedo and exposure time in units of the standard deviation of its prior. T is
  // double or a type for automatic differentiation. An LED behind the plane or a point more than 90
  // degrees off the axis contributes nothing.
  template <typename T>
  T radiance(const T* led, const T* pose, const T* albedo, const T* exposure) const;

 private:
  static constexpr int kPoints = 4;  // of a cell, and of the ring of the LED

  const LedFrame& frame_;
  int channel_;
  Eigen::Vector3d normal_;
  double albedo_over_pi_, albedo_std_, exposure_std_;
  std::array<Eigen::Vector3d, kPoints> points_mm_;
  Eigen::Matrix<double, 3, 6> shift_;  // of the points, by the unknowns of the pose
  std::vector<Eigen::Vector3d> ring_mm_;
};

// Radiance of a cell under an LED alone, W/(mm^2 sr), with the nominal poses, albedo and exposure
// times of the scene.
double cell_radiance(const LedScene& scene, const ShadedCell& cell, const Led& led);

template <typename T>
T CellModel::radiance(const T* led, const T* pose, const T* albedo, const T* exposure) const {
  using std::exp;
  using std::pow;
  using std::sqrt;
  using Vector3T = Eigen::Matrix<T, 3, 1>;
  if (!(frame_.led.intensity_W_per_sr[channel_] > 0.0)) return T(0.0);
  const Eigen::Map<const Vector3T> position(led);
  Vector3T axis = frame_.led.axis.cast<T>() + led[3] * frame_.tangents[0].cast<T>() +
                  led[4] * frame_.tangents[1].cast<T>();
  axis /= sqrt(axis.squaredNorm());
  const Eigen::Map<const Eigen::Matrix<T, 6, 1>> z(pose);
  const Vector3T shift = shift_.cast<T>() * z;
  T sum(0.0);
  for (const Eigen::Vector3d& point : points_mm_) {
    for (const Eigen::Vector3d& offset : ring_mm_) {
      const Vector3T to_led = position + offset.cast<T>() - point.cast<T>() - shift;
      const T r2 = to_led.squaredNorm();
      const T r = sqrt(r2);
      const T cosine = normal_.cast<T>().dot(to_led) / r;
      const T lobe = -axis.dot(to_led) / r;
      if (!(cosine > T(0.0)) || !(lobe > T(1e-6))) continue;
      T at = pow(lobe, led[5]) * cosine / r2;
      if (frame_.led.table) at *= frame_.led.table->value<T>(axis, -to_led / r);
      sum += at;
    }
  }
  const double share = 1.0 / static_cast<double>(points_mm_.size() * ring_mm_.size());
  return T(albedo_over_pi_ * share) * (T(1.0) + T(albedo_std_) * albedo[0]) *
         (T(1.0) + T(exposure_std_) * exposure[0]) * exp(led[6 + channel_]) * sum;
}

}  // namespace scattermeter::calib
