// The point about which an LED's least squares counts its unknowns.
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
// along the tangents (0 is the frame's axis), exponent, log intensity. A view's pose takes six
// unknowns of unit deviation, ambient light one per plane shot and channel in units of
// ambient_unit.
struct LedFrame {
  const LedScene& scene;
  Lens lens;
  Led led;
  std::array<Eigen::Vector3d, 2> tangents;  // unit, at right angles to led.axis and to each other
  // By view: a root of the pose's covariance, so that root z has that covariance for z of unit
  // deviation.
  std::vector<Eigen::Matrix<double, 6, 6>> pose_root;
  std::vector<Eigen::Array3d> ambient_unit;  // by plane shot, W/(mm^2 sr): mean of its cells, > 0

  LedFrame(const LedScene& led_scene, const Led& center);  // keeps a reference to the scene

  // The LED at x. Channels of no intensity keep none.
  Led at(const double* x) const;

  // The unknowns of the frame's own LED; the log intensity of a channel of none is 0.
  std::array<double, kLedParameters> start() const;
};

}  // namespace scattermeter::calib
