// Cameras, layouts and noisy shots of known pose for calib's tests.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/Core>

#include "calib/pose.h"

namespace scattermeter::calib {

// A 60 mm lens near its closest focus on a 3872 x 2592 sensor.
CameraIntrinsics long_lens();
// A wide lens with strong barrel distortion: 0.55 rad and 190 px of it at the corner.
CameraIntrinsics wide_lens();

// Pose of a camera at `distance_mm` from the world point `target_mm`, which appears near the middle
// of the frame. The world's z axis leans by tilt_rad from the line of sight, towards azimuth_rad in
// the image; at tilt 0 it points at the camera.
Rigid3d camera_looking_at(const Eigen::Vector3d& target_mm, double distance_mm, double tilt_rad,
                          double azimuth_rad);

// Eight corners of the cube [-half, half]^3 and the middles of four edges.
std::vector<Eigen::Vector3d> cube_points(double half_mm);
// Four corners of a square in z = 0.
std::vector<Eigen::Vector3d> square_points(double half_mm);
// Random in [-half, half]^2 x [-thickness / 2, thickness / 2].
std::vector<Eigen::Vector3d> slab_points(int count, double half_mm, double thickness_mm,
                                         std::mt19937_64* random);

// The points' images with Gaussian noise of noise_px per coordinate.
std::vector<PointPair> shot(const CameraIntrinsics& intrinsics, const Rigid3d& camera_from_world,
                            const std::vector<Eigen::Vector3d>& points_mm, double noise_px,
                            std::mt19937_64* random);

// Puts the images of the first `count` pairs at random places of the frame.
void spoil(const CameraIntrinsics& intrinsics, int count, std::vector<PointPair>* pairs,
           std::mt19937_64* random);

// (w, dt) of PoseResult::covariance that leads from the estimate to the truth.
Eigen::Matrix<double, 6, 1> pose_error(const Rigid3d& estimate, const Rigid3d& truth);

}  // namespace scattermeter::calib
