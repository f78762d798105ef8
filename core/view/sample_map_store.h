// Where the views of a jig are kept between programs.
#pragma once

#include "core/base/kept_store.h"
#include "core/view/camera_view.h"
#include "core/view/sample_map.h"

namespace scattermeter {

using SampleMapStore = KeptStore<SampleMap>;

// map_samples() of rays_around() the mesh with a margin of twice the guard, from the store if it is
// there; else computed and kept. It is named by all that it follows from: camera, pose, mesh, patch
// size, eta and options. store: may be null. Preconditions: those of rays_around(), and that the
// patches are those of the scene's mesh.
SampleMap map_samples(const CameraView& view, const RayScene& scene, const PatchMesh& patches,
                      double eta_int_over_ext, const SampleMapOptions& options,
                      SampleMapStore* store);

}  // namespace scattermeter
