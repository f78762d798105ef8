// Rays of a plain pinhole for tests of core, which knows no camera model.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/sample_map.h"

namespace scattermeter::test_support {

// width x height pixels of focal length f_px from `from` towards `at`, world z up in the picture.
inline RayGrid pinhole_rays(const Eigen::Vector3d& from, const Eigen::Vector3d& at, double f_px,
                            int width, int height) {
  const Eigen::Vector3d z = (at - from).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d y = z.cross(x);
  RayGrid grid;
  grid.origin_in_world_mm = from;
  grid.width = width;
  grid.height = height;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      grid.directions_in_world.push_back(
          (z + (u - 0.5 * (width - 1)) / f_px * x + (v - 0.5 * (height - 1)) / f_px * y)
              .cast<float>());
    }
  }
  return grid;
}

}  // namespace scattermeter::test_support
