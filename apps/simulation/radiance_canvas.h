// A frame of radiance that is being painted.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/camera/cfa_pattern.h"
#include "core/camera/lens.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {

// Black at first. Each pixel holds the radiance in the channel of its own filter.
class RadianceCanvas {
 public:
  RadianceCanvas(const CfaPattern& cfa, const CameraView& view)
      : cfa_(cfa),
        width_(static_cast<std::size_t>(view.intrinsics.width_px)),
        lens_(view.intrinsics),
        world_from_camera_(view.camera_from_world.rotation.conjugate()),
        eye_mm(view.center_in_world_mm()),
        pixels(width_ * static_cast<std::size_t>(view.intrinsics.height_px), 0.0F) {}

  int channel(int x, int y) const { return static_cast<int>(cfa_.at(x, y)); }
  float& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)];
  }
  // Direction into the scene through a point of the frame, px; of any length.
  Eigen::Vector3d ray(double x, double y) const {
    return world_from_camera_ * lens_.unproject({x, y}).homogeneous();
  }

 private:
  CfaPattern cfa_;
  std::size_t width_;
  Lens lens_;
  Eigen::Quaterniond world_from_camera_;

 public:
  Eigen::Vector3d eye_mm;     // centre of the camera in the world
  std::vector<float> pixels;  // row by row
};

}  // namespace scattermeter::apps
