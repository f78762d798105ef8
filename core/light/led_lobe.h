// The lobe of an LED as a table, as data sheets and goniometers give it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace scattermeter {

// Radiant intensity against the angle from the axis, in one plane for a lobe that is round, or in
// two perpendicular planes through the axis. Between the angles: monotone cubic Hermite
// interpolation (Fritsch and Butland 1984), which neither overshoots nor has kinks. Between the
// planes: cos^2 and sin^2 of the azimuth as weights, which an elliptical lobe has near its axis.
class LobeTable {
 public:
  // angles_rad: at least two, increasing, from 0 or from a negative angle on, from which the two
  // planes are then not symmetric; the last one (and the first, if negative) reaches pi/2, or has
  // intensity 0 and so has all beyond. in_x, in_y: intensities at these angles relative to the
  // LED's intensity_W_per_sr, each at least 0 and not all 0, equal in both planes at angle 0, which
  // must be listed; in_y empty: a round lobe, whose angles begin at 0. x_axis: direction (world,
  // any length) that with the LED's axis spans the plane of in_x; positive angles are on its side.
  // Those of in_y are on the side of axis x x_axis. Throws std::invalid_argument.
  LobeTable(std::vector<double> angles_rad, std::vector<double> in_x, std::vector<double> in_y = {},
            const Eigen::Vector3d& x_axis = Eigen::Vector3d::UnitX());

  // Relative intensity towards `unit_direction`, for an LED with this axis (unit length, not
  // parallel to x_axis unless the lobe is round); 0 behind the LED. T is double or a type for
  // automatic differentiation.
  template <typename T>
  T value(const Eigen::Matrix<T, 3, 1>& axis, const Eigen::Matrix<T, 3, 1>& unit_direction) const;

  const std::vector<double>& angles_rad() const { return angles_rad_; }
  const std::vector<double>& in_x() const { return in_x_.values; }
  const std::vector<double>& in_y() const { return in_y_.values; }
  const Eigen::Vector3d& x_axis() const { return x_axis_; }
  bool is_round() const { return in_y_.values.empty(); }
  // Whether x_axis is far enough (0.1 rad) from an LED's axis (unit length) to determine the
  // planes.
  bool has_planes_about(const Eigen::Vector3d& axis) const {
    return is_round() || axis.cross(x_axis_.normalized()).norm() > 0.1;
  }

 private:
  struct Plane {
    std::vector<double> values, slopes;
  };
  Plane plane(std::vector<double> values) const;
  template <typename T>
  T interpolate(const Plane& plane, const T& angle_rad) const;
  std::vector<double> angles_rad_;
  Eigen::Vector3d x_axis_;
  Plane in_x_, in_y_;
};

template <typename T>
T LobeTable::interpolate(const Plane& plane, const T& angle_rad) const {
  const std::vector<double>& a = angles_rad_;
  // Beyond the last angle there is nothing, but for rounding at 90 degrees.
  if (angle_rad < T(a.front())) return T(plane.values.front());
  if (angle_rad > T(a.back())) return T(plane.values.back());
  const auto above = std::upper_bound(a.begin() + 1, a.end() - 1, angle_rad,
                                      [](const T& angle, double node) { return angle < T(node); });
  const auto i = static_cast<std::size_t>(above - a.begin()) - 1;
  const double h = a[i + 1] - a[i];
  const T t = (angle_rad - T(a[i])) / T(h);
  const T s = T(1.0) - t;
  return s * s * ((T(1.0) + T(2.0) * t) * T(plane.values[i]) + t * T(h * plane.slopes[i])) +
         t * t * ((T(1.0) + T(2.0) * s) * T(plane.values[i + 1]) - s * T(h * plane.slopes[i + 1]));
}

template <typename T>
T LobeTable::value(const Eigen::Matrix<T, 3, 1>& axis,
                   const Eigen::Matrix<T, 3, 1>& unit_direction) const {
  using std::atan2;
  using std::sqrt;
  using Vector3T = Eigen::Matrix<T, 3, 1>;
  const T c = axis.dot(unit_direction);
  if (!(c > T(0.0))) return T(0.0);
  const Vector3T across = unit_direction - c * axis;
  const T s2 = across.squaredNorm();
  if (!(s2 > T(1e-24))) return interpolate(in_x_, T(0.0));
  const T angle_rad = atan2(sqrt(s2), c);
  if (is_round()) return interpolate(in_x_, angle_rad);
  const Vector3T given = x_axis_.cast<T>();
  const Vector3T x = (given - given.dot(axis) * axis).normalized();
  const T along_x = across.dot(x);
  const T along_y = across.dot(axis.cross(x));
  const bool is_signed = angles_rad_.front() < 0.0;
  const auto in = [&](const Plane& plane, const T& along) {
    return interpolate(plane, is_signed && along < T(0.0) ? T(-angle_rad) : angle_rad);
  };
  return (along_x * along_x * in(in_x_, along_x) + along_y * along_y * in(in_y_, along_y)) / s2;
}

}  // namespace scattermeter
