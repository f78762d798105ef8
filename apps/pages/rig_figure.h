// A rig in three dimensions, on a page.
#pragma once

#include <string>

#include "apps/instrument/rig_places.h"
#include "apps/pages/html_page.h"
#include "core/mesh/triangle_mesh.h"

namespace scattermeter::apps {

// A mesh of about the same shape for a picture: of more than `most` triangles, the vertices are
// merged within the cells of a grid; one of few is cut finer, so that a painter who sorts whole
// triangles by depth sorts them right.
TriangleMesh drawable_mesh(const TriangleMesh& mesh, std::size_t most = 2500);

// What apps/pages/web/rig_view.js draws, as JSON: lists of coordinates, world frame, mm.
std::string rig_data(const RigPlaces& places);

// The view, to be turned by hand, and the positions as a folded table.
Html rig_figure(const RigPlaces& places);

}  // namespace scattermeter::apps
