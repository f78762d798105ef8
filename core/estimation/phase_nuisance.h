// Change of a channel's light by the phase function of the material.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/estimation/channel_rows.h"
#include "core/estimation/material_channel.h"
#include "core/fit/scattering_equation.h"
#include "core/scene/scene.h"

namespace scattermeter {

// Per unit of gamma (PhaseFunction::gamma()) at the same sigma_s' and sigma_a: light leaves farther
// from its entry, and leaves in other directions (core/material/phase_effect.h). On a cube of 20 mm
// with l' of 1.1 mm, going from isotropic scattering to Henyey and Greenstein's with g = 0.8 takes
// 4 % of the light that the camera sees, 8 % at edges; that is met to half a per cent in all
// (test).
class PhaseNuisance {
 public:
  // Scene and channel must outlive the object.
  PhaseNuisance(const Scene& scene, const MaterialChannel& channel, const DistanceKnots& knots)
      : scene_(scene), channel_(channel), knots_(knots) {}

  // From now on, changes have the rows whose state is kUsed, shot by shot.
  void set_rows(const ChannelRows& rows);
  // Change of l. weights: W of those rows.
  Eigen::VectorXd change(const WeightMatrix& weights, const ScatteringPoint& at) const;

 private:
  const Scene& scene_;
  const MaterialChannel& channel_;
  DistanceKnots knots_;
  // By row: -l_t . c_t in the mean over the irradiance by LEDs, without shadows; other light comes
  // from everywhere.
  Eigen::VectorXd turn_;
};

}  // namespace scattermeter
