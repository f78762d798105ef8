#include "tests/calib/pose_scenes.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace scattermeter::calib {

CameraIntrinsics long_lens() { return {3872, 2592, 9836, 9836, 1935.5, 1295.5, {}}; }

CameraIntrinsics wide_lens() {
  return {3872, 2592, 2800, 2790, 1950.0, 1280.0, {-0.3, 0.12, 0.001, -0.0005, -0.02}};
}

Rigid3d camera_looking_at(const Eigen::Vector3d& target_mm, double distance_mm, double tilt_rad,
                          double azimuth_rad) {
  // Half a turn about x brings the world's z axis (up) to the camera's -z (towards the viewer).
  const Eigen::Quaterniond facing(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()));
  const Eigen::Vector3d axis(-std::sin(azimuth_rad), std::cos(azimuth_rad), 0);
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(tilt_rad, axis));
  Rigid3d pose;
  pose.rotation = (tilt * facing).normalized();
  pose.translation_mm = Eigen::Vector3d(0.01, -0.006, 1) * distance_mm - pose.rotation * target_mm;
  return pose;
}

std::vector<Eigen::Vector3d> cube_points(double half_mm) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(12);
  for (int i = 0; i < 8; ++i) {
    points.emplace_back((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
  }
  points.insert(points.end(), {{0, -1, 1}, {0, 1, 1}, {1, 0, 1}, {-1, 0, 1}});
  for (Eigen::Vector3d& point : points) point *= half_mm;
  return points;
}

std::vector<Eigen::Vector3d> square_points(double half_mm) {
  return {{-half_mm, -half_mm, 0},
          {half_mm, -half_mm, 0},
          {half_mm, half_mm, 0},
          {-half_mm, half_mm, 0}};
}

std::vector<Eigen::Vector3d> slab_points(int count, double half_mm, double thickness_mm,
                                         std::mt19937_64* random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const double x = uniform(*random);
    const double y = uniform(*random);
    const double z = uniform(*random);
    points.emplace_back(half_mm * x, half_mm * y, 0.5 * thickness_mm * z);
  }
  return points;
}

std::vector<PointPair> shot(const CameraIntrinsics& intrinsics, const Rigid3d& camera_from_world,
                            const std::vector<Eigen::Vector3d>& points_mm, double noise_px,
                            std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  const std::vector<Eigen::Vector2d> images = project(intrinsics, camera_from_world, points_mm);
  std::vector<PointPair> pairs;
  for (size_t i = 0; i < points_mm.size(); ++i) {
    const double du = noise_px * normal(*random);
    const double dv = noise_px * normal(*random);
    pairs.push_back({points_mm[i], images[i] + Eigen::Vector2d(du, dv)});
  }
  return pairs;
}

void spoil(const CameraIntrinsics& intrinsics, int count, std::vector<PointPair>* pairs,
           std::mt19937_64* random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  for (size_t i = 0; i < static_cast<size_t>(count); ++i) {
    const double u = uniform(*random);
    const double v = uniform(*random);
    (*pairs)[i].image_px = {u * intrinsics.width_px, v * intrinsics.height_px};
  }
}

Eigen::Matrix<double, 6, 1> pose_error(const Rigid3d& estimate, const Rigid3d& truth) {
  const Eigen::AngleAxisd turn(truth.rotation * estimate.rotation.conjugate());
  Eigen::Matrix<double, 6, 1> error;
  error << turn.angle() * turn.axis(), truth.translation_mm - estimate.translation_mm;
  return error;
}

}  // namespace scattermeter::calib
