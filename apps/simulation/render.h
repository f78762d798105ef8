// Pictures of measured materials on the objects of a rig, under its lights.
#pragma once

#include <string>
#include <vector>

#include "apps/results/result_reader.h"
#include "apps/rig/rig.h"
#include "apps/simulation/shot_renderer.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

struct RenderOptions {
  std::vector<std::string> objects;  // only these of the rig; empty: those of its shots
  // On together, for each object; empty: each combination of lights in the rig's shots of it.
  std::vector<std::string> lights;
  int width_px = 0;  // of the frame, with the rig's aspect ratio; 0: the rig's
  RenderTransport transport;
  Progress* progress = nullptr;
};

// An object under one or more lights.
struct RenderScene {
  std::string object;
  std::vector<std::string> lights;
};

struct RenderedPicture {
  std::size_t scene_idx = 0;
  std::size_t material_idx = 0;
  ColourRadiance radiance;
  double monte_carlo_std = 0;  // see ShotRenderer, largest so far
};

struct Rendering {
  std::vector<RenderScene> scenes;
  std::vector<RenderedPicture> pictures;  // scene by scene, in each the materials in their order
};

// Renders every scene with every material, which has its own eta. The camera is at truth.pose, or
// at the pose from the pose points. Throws InputError for a rig without either, for an object or
// light that it does not have, for an object out of view, and for what simulate() refuses.
Rendering render(const Rig& rig, const std::vector<MeasuredMaterial>& materials,
                 const RenderOptions& options);

}  // namespace scattermeter::apps
