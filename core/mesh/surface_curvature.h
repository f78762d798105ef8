// How the normal turns along the smooth surface that a mesh of small facets stands for.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

// Facets that meet at less than kCrease_rad (core/mesh/creases.h) and whose edges are no farther
// than this from a curve through them (an eighth of their width times that angle) stand for a
// smooth surface: half of what the position of a careful user's piece is known to. Facets of a
// wedge or of a coarse body do not.
inline constexpr double kMostSagitta_mm = 0.05;

// Of every facet: the change of the surface's unit normal by a shift along the facet, 1/mm, as that
// of the normals interpolated between its corners; a corner has the mean of the normals of the
// facets there that are one smooth surface with it, weighted so that it is exact on a sphere (N.
// Max, Weights for computing vertex normals from facet normals, Journal of Graphics Tools 4, 1999).
// Zero where all of these are the facet's own: on flat faces. On a sphere of radius r: shift / r.
std::vector<Eigen::Matrix3d> normal_change_per_mm(const TriangleMesh& mesh);

}  // namespace scattermeter
