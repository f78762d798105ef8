// Pictures of materials on a body that is the same for all of them.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "apps/simulation/shot_renderer.h"
#include "core/material/medium.h"

namespace scattermeter::apps {

inline constexpr double kStandardCube_mm = 20.0;

// Places in the picture: the middle of the face that is lit most, and the face in shadow, 2 mm
// behind the edge that it shares with a lit one.
enum class StandardPlace { kLit, kShadow };
inline constexpr double kBehindEdge_mm = 2.0;

// The cube of core/mesh/bodies.h from above one of its edges, alone on black, under even white
// light from one direction, from above and from the left. It reaches one of the three visible faces
// through the material only. Radiance is relative to that of a white matt surface that faces the
// light; the gloss of the surface is not part of it. By the dipole, which counts at each point the
// light within a half-space.
struct StandardBody {
  ColourRadiance picture;

  // R, G, B at the pixel in which the place is seen.
  Eigen::Array3d at(StandardPlace place) const;
};

// A picture of each of the materials (R, G, B), all of one size, some 96 px. Costs little more for
// several similar materials than for one: sums over pairs of points are shared. Precondition: all
// media have the same eta_int_over_ext.
std::vector<StandardBody> standard_bodies(const std::vector<std::array<Medium, 3>>& materials);

}  // namespace scattermeter::apps
