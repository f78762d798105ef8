// The effect of edges that are not as sharp as those of the mesh.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/estimation/light_sensitivity.h"
#include "core/light/led.h"
#include "core/mesh/creases.h"
#include "core/scene/observed_shot.h"

namespace scattermeter {

// Light of an LED that enters along an edge, per mm of length and per mm by which each of its two
// faces is cut back, as a change: |n_a + n_b| E(n_a + n_b) - E(n_a) - E(n_b), with E the
// transmitted irradiance, sr/mm^2 per W/sr, of a chamfer and of the faces that it replaces. At most
// 0 but for the angle dependence of the transmittance: of an edge between two lit faces almost
// nothing is lost, of one between a lit and a dark face what the chamfer, seen from the LED, covers
// less.
double light_by_chamfer_per_mm(const Led& led, const Crease& edge, const Eigen::Vector3d& point_mm,
                               double eta_int_over_ext);

// dl / dw on the rows of a view, w the mm by which all edges of the mesh sharper than 0.3 rad are
// cut back, per unit of the LED's intensity: rows x media, to first order in w, for points of edges
// that the LED sees. Empty if no light is lost, as on a round body.
Eigen::MatrixXd change_by_edges(const SeenObject& seen, const Led& led, const DistanceKnots& knots,
                                const std::vector<LitMedium>& media);

}  // namespace scattermeter
