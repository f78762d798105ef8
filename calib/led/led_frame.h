// Reference point of the unknowns in the least squares for an LED.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "calib/led/led_scene.h"
#include "core/camera/lens.h"
#include "core/light/led.h"
#include "core/light/led_uncertainty.h"

namespace scattermeter::calib {

// The LED's unknowns x are the parameters of LedUncertainty: position in mm, two steps of the axis
// along the tangents (0 is the frame's axis), exponent, log intensity. The pose of a view has six
// unknowns of unit standard deviation; ambient light has one for each plane shot and channel in
// units of ambient_unit.
struct LedFrame {
  const LedScene& scene;
  Lens lens;
  Led led;
  std::array<Eigen::Vector3d, 2> tangents;  // unit vectors orthogonal to led.axis and to each other
  // For each view a root of the pose's covariance: root z has that covariance if z has unit
  // covariance.
  std::vector<Eigen::Matrix<double, 6, 6>> pose_root;
  std::vector<Eigen::Array3d> ambient_unit;  // per plane shot, W/(mm^2 sr): mean of its cells, > 0

  LedFrame(const LedScene& led_scene, const Led& center);  // keeps a reference to the scene

  // The LED at x. Channels without intensity remain so.
  Led at(const double* x) const;

  // The unknowns of the LED of the frame; the log intensity of a channel without intensity is 0.
  std::array<double, kLedParameters> start() const;
};

}  // namespace scattermeter::calib
