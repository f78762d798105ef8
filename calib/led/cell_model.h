// The radiance of a white plane's cell under an LED, as a function of the fit's unknowns.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "calib/led/led_frame.h"
#include "calib/led/led_scene.h"

namespace scattermeter::calib {

//   L = albedo / pi * I * lobe(w) * cos / r^2,
// the mean over four points that have the cell's spread and over the LED's disc (four points on a
// ring of radius / sqrt 2, exact to the second order). Keeps a reference to the frame.
class CellModel {
 public:
  CellModel(const LedFrame& frame, const ShadedCell& cell);

  // W/(mm^2 sr) at the unknowns of LedFrame: the LED's nine, the view's six, and one each, in units
  // of its prior's deviation, for albedo and exposure time. T: double or an automatic derivative.
  // Points behind the plane or more than 90 degrees off the axis get no light.
  template <typename T>
  T radiance(const T* led, const T* pose, const T* albedo, const T* exposure) const;

 private:
  static constexpr int kPoints = 4;  // of a cell, and of the LED's ring

  const LedFrame& frame_;
  int channel_;
  Eigen::Vector3d normal_;
  double albedo_over_pi_, albedo_std_, exposure_std_;
  std::array<Eigen::Vector3d, kPoints> points_mm_;
  Eigen::Matrix<double, 3, 6> shift_;  // of the points by the pose's unknowns
  std::vector<Eigen::Vector3d> ring_mm_;
};

// Radiance of a cell under an LED alone, W/(mm^2 sr), at the scene's nominal poses, albedo and
// exposure times.
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
      sum += pow(lobe, led[5]) * cosine / r2;
    }
  }
  const double share = 1.0 / static_cast<double>(points_mm_.size() * ring_mm_.size());
  return T(albedo_over_pi_ * share) * (T(1.0) + T(albedo_std_) * albedo[0]) *
         (T(1.0) + T(exposure_std_) * exposure[0]) * exp(led[6 + channel_]) * sum;
}

}  // namespace scattermeter::calib
