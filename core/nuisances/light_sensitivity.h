// Sensitivity of the image of one light to the uncertain quantities of the setup.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/diffusion/weight_store.h"
#include "core/fit/estimate.h"
#include "core/material/medium.h"
#include "core/scene/lit_objects.h"
#include "core/scene/seen_object.h"
#include "core/view/row_interpolation.h"

namespace scattermeter {

// A material, as first estimated, seen under one light in one view.
struct LitMedium {
  Medium medium;
  double scale = 1;  // measured over predicted, of the first estimate
};

LitMedium lit_medium(const Estimate& first);  // with an eta of 1

// Change of l (per unit of the light's power) on the rows of a view for each medium: rows x media.
// Those by the light's quantities that are stated as exact are left out.
struct LightSensitivity {
  Eigen::MatrixXd l;                              // nominal
  std::vector<Eigen::MatrixXd> per_change;        // by each quantity of Light::changes()
  Eigen::MatrixXd per_eta;                        // by eta, of the l observed with the stated one
  std::array<Eigen::MatrixXd, 2> per_tangent_mm;  // by a shift of the sites along tangents()
  Eigen::MatrixXd per_albedo;                     // by the albedo of the plane below; of LEDs only
  Eigen::MatrixXd per_edge_mm;  // by the mm by which edges are cut back; of LEDs only; may be empty
};

// R on the knots times the medium's scale, one column for each medium.
Eigen::MatrixXd scaled_curves(const std::vector<LitMedium>& media, const DistanceKnots& knots,
                              double eta_int_over_ext);

// For weights to about 1e-3, which is sufficient for standard deviations.
PairSumOptions coarse_pair_options(const DistanceKnots& knots);

// Half as many knots for the same distances, with wider bins between them: their error is the same
// before and after a change.
DistanceKnots coarse_knots(const DistanceKnots& knots);

// A view under a light, nominal and with one quantity changed at a time, at the centres of the
// sites, with light on patches of twice the size: discretisation errors cancel in relative changes,
// which are nearly constant over a site. Quantities stated as exact are not changed (no rows).
// Relative changes of the light vary no faster than patches of twice the size show: some rows are
// enough.
template <class Each>
struct Changed {
  Each nominal;
  RowInterpolation some;      // the rows that the next three have
  std::vector<Each> changed;  // the light, as Light::changes()
  std::vector<double> steps;  // of these
  Each other_eta;
  std::array<Each, 2> shifted;  // the sites, by shift_mm along two tangents
  double shift_mm = 0;
};
// W: with these, the sensitivities for any medium can be computed.
using ChangedWeights = Changed<WeightMatrix>;
// The images for some media, rows x media: smaller than W by a factor of the number of knots over
// that of media.
using ChangedImages = Changed<Eigen::MatrixXd>;
// `channel`: of the light. store: may be null. W is on coarse_knots(knots).
ChangedWeights changed_weights(const SeenObject& seen, const SceneLight& light, std::size_t channel,
                               LitObjects& lit, const DistanceKnots& knots,
                               WeightStore* store = nullptr);
ChangedImages changed_images(const SeenObject& seen, const SceneLight& light, std::size_t channel,
                             LitObjects& lit, const DistanceKnots& knots,
                             const std::vector<LitMedium>& media);
ChangedImages changed_images(const SeenObject& seen, const ChangedWeights& weights,
                             const DistanceKnots& knots, const std::vector<LitMedium>& media);

// The centres of the view's sites.
std::vector<ExitSite> sites_at_centers(const SeenObject& seen);
// Images of some light on sites of an object, rows x media, to about 1 %. By W, so that the digits
// of a medium do not depend on the others. store: may be null.
Eigen::MatrixXd coarse_images(const ObjectScene& object, const std::vector<ExitSite>& sites,
                              const IncidentLight& light, const DistanceKnots& knots,
                              const std::vector<LitMedium>& media, WeightStore* store);

// From differences of the changed images and the nominal ones, relative to the prediction of
// `nominal`, the W used for the measurement, for the same media.
LightSensitivity sensitivity(const SeenObject& seen, const WeightMatrix& nominal,
                             const ChangedImages& images, const std::vector<LitMedium>& media,
                             const DistanceKnots& knots);

// Takes the change by eta, per unit, over each medium's own step, which is as far from the stated
// eta as its image puts it; where that is 0, as it is. So far off, the change is not linear.
// sensitivity: of the same view, light and media.
void set_far_per_eta(const SeenObject& seen, const SceneLight& light, std::size_t channel,
                     LitObjects& lit, const DistanceKnots& knots,
                     const std::vector<LitMedium>& media, const std::vector<double>& offsets,
                     LightSensitivity& sensitivity);

}  // namespace scattermeter
