// How the image of one light depends on what the rig states only to a standard deviation.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/material/medium.h"
#include "core/scene/lit_objects.h"
#include "core/scene/seen_object.h"

namespace scattermeter {

// A material, as first estimated, seen under one light in one view.
struct LitMedium {
  Medium medium;
  double scale = 1;  // measured over predicted, of the first estimate
};

// Change of l (per unit of the light's power) on the rows of a view for each medium: rows x media.
// Empty where the rig states the quantity as exact.
struct LightSensitivity {
  Eigen::MatrixXd l;                              // nominal
  std::vector<Eigen::MatrixXd> per_change;        // by the quantities of Light::changes()
  Eigen::MatrixXd per_eta;                        // by eta, of l - observed l: both depend on it
  std::array<Eigen::MatrixXd, 2> per_tangent_mm;  // by moving the sites along two tangents
};

// For weights to some 1e-3: deviations need no more.
PairSumOptions coarse_pair_options(const DistanceKnots& knots);

// A view under a light, nominal and with one thing changed at a time. At the centres of the sites,
// from light on patches of twice the size: errors of discretisation cancel in relative changes, and
// these are nearly the same all over a site. What the rig states as exact is not changed (no rows).
template <class Each>
struct Changed {
  Each nominal;
  std::vector<Each> changed;  // the light, as Light::changes()
  std::vector<double> steps;  // of these
  Each other_eta;
  std::array<Each, 2> shifted;  // the sites, by shift_mm along two tangents
  double shift_mm = 0;
};
// W: all that the sensitivities of any medium need of the geometry.
using ChangedWeights = Changed<WeightMatrix>;
// The images themselves of some media, rows x media: as many numbers as W has knots times
// fewer.
using ChangedImages = Changed<Eigen::MatrixXd>;
// `channel`: of the light.
ChangedWeights changed_weights(const SeenObject& seen, const SceneLight& light, std::size_t channel,
                               LitObjects& lit, const DistanceKnots& knots);
ChangedImages changed_images(const SeenObject& seen, const SceneLight& light, std::size_t channel,
                             LitObjects& lit, const DistanceKnots& knots,
                             const std::vector<LitMedium>& media);
ChangedImages changed_images(const SeenObject& seen, const ChangedWeights& weights,
                             const DistanceKnots& knots, const std::vector<LitMedium>& media);

// By differences of the changed images and the nominal ones, relative to what `nominal`, the W
// that is measured with, predicts of the same media.
LightSensitivity sensitivity(const SeenObject& seen, const WeightMatrix& nominal,
                             const ChangedImages& images, const std::vector<LitMedium>& media,
                             const DistanceKnots& knots);

// Two unit tangents of a row's facet; per_tangent_mm goes along them.
std::array<Eigen::Vector3d, 2> tangents(const Eigen::Vector3d& normal);

}  // namespace scattermeter
