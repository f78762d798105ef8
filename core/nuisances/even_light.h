// Unlisted, uniform light on the objects: other lamps, and what the room returns of the LEDs'
// light.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/nuisances/light_sensitivity.h"
#include "core/nuisances/nuisances.h"
#include "core/scene/lit_objects.h"
#include "core/scene/observed_shot.h"

namespace scattermeter {

// The key of a view under uniform light: that of a light without a name.
LightKey even_light_key(const ObservedShot& shot);
// Whether the shot may contain such light: it lists an LED, and no light that is fitted.
bool may_have_even_light(const Scene& scene, const ObservedShot& shot);

// l on the rows of a view under light of radiance 1 from all sides, W/mm^2 per W/(mm^2 sr), for
// each medium: rows x media, to about 1 %. store: of W, may be null.
Eigen::MatrixXd even_light_images(const SeenObject& seen, const DistanceKnots& knots,
                                  const std::vector<LitMedium>& media,
                                  WeightStore* store = nullptr);

// The same under light of radiance w_k from the direction w, k = x, y, z in the world: with light
// from all sides, light that comes more from one of them. even: even_light_images().
std::array<Eigen::MatrixXd, 3> light_from_axes_images(const SeenObject& seen,
                                                      const DistanceKnots& knots,
                                                      const std::vector<LitMedium>& media,
                                                      const Eigen::MatrixXd& even,
                                                      WeightStore* store = nullptr);

// Irradiance by the shot's LEDs of surfaces at the object's centre that face them, unshadowed,
// W/mm^2, summed; channel 0 R, 1 G, 2 B.
double facing_irradiance_W_per_mm2(const Scene& scene, const ObservedShot& shot,
                                   std::size_t channel);

}  // namespace scattermeter
