// The effect of edges that are not as sharp as those of the mesh.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/light/led.h"
#include "core/mesh/creases.h"
#include "core/nuisances/light_sensitivity.h"
#include "core/scene/observed_shot.h"

namespace scattermeter {

// A convex edge of which `width_mm` of each of the two faces is cut off.
struct ChamferedEdge {
  std::array<Eigen::Vector3d, 2> inward_mm;  // from the edge to the chamfer's edges, in the faces
  Eigen::Vector3d normal;                    // of the chamfer
  bool is_convex = false;
};
// The edge's direction must be that of its second facet, as in creases().
ChamferedEdge chamfered(const Crease& edge, double width_mm);

// The width of the chamfers of which change_by_edges() takes the effect as long as none has been
// fitted, mm: 1.5 standard deviations of the object's edges, so that the second order is right for
// wide ones, or a small one where the edges are stated as exact.
double chamfer_width_mm(const SceneObject& object);

// dl / dw on the rows of a view, w the mm of each face by which all convex edges of the mesh
// sharper than 0.3 rad are cut back, per unit of the LED's intensity: rows x media. It is the
// change by chamfers of widths_mm > 0, one for each medium, over their width: light enters through
// the chamfer instead of the strips of both faces. Its amount changes where one of the faces is
// dark; where it enters, always, which is of second order in w and yet a per cent of the light just
// round an edge for w a seventh of the mean free path. For points of edges that the LED sees; empty
// if there are none, as on a round body. store: of W, may be null.
Eigen::MatrixXd change_by_edges(const SeenObject& seen, const Led& led, const DistanceKnots& knots,
                                const std::vector<LitMedium>& media,
                                const std::vector<double>& widths_mm, WeightStore* store = nullptr);

}  // namespace scattermeter
