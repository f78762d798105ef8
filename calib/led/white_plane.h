// A matt white rectangle.
#pragma once

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace scattermeter::calib {

// Lambertian: radiance = albedo / pi times irradiance. Lengths in mm, world frame. Points are
// origin + x x_axis + y y_axis, 0 <= x <= width, 0 <= y <= height; it faces along x_axis x y_axis.
struct WhitePlane {
  Eigen::Vector3d origin_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d x_axis = Eigen::Vector3d::UnitX();  // unit vectors at right angles
  Eigen::Vector3d y_axis = Eigen::Vector3d::UnitY();
  double width_mm = 0;
  double height_mm = 0;
  Eigen::Array3d albedo = Eigen::Array3d::Ones();  // R, G, B, in (0, 1]
  // Relative standard deviation of the albedo: a single error, common to the channels and to all
  // planes (the same sheet at several heights).
  double albedo_relative_std = 0;

  Eigen::Vector3d normal() const { return x_axis.cross(y_axis); }
  // Coordinates (x, y) in mm of the point where a ray meets the front of the plane, inside or
  // outside the rectangle; none if it does not.
  std::optional<Eigen::Vector2d> meet_mm(const Eigen::Vector3d& eye_mm,
                                         const Eigen::Vector3d& direction) const {
    const double height = normal().dot(eye_mm - origin_mm);
    const double fall = -normal().dot(direction);
    if (!(height > 0.0) || !(fall > 0.0)) return std::nullopt;
    const Eigen::Vector3d p = eye_mm + height / fall * direction - origin_mm;
    return Eigen::Vector2d(p.dot(x_axis), p.dot(y_axis));
  }
};

}  // namespace scattermeter::calib
