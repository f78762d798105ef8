// A shot in small, with the mesh's edges over it and what is left out marked.
#pragma once

#include <string>

#include "apps/camera_view.h"
#include "apps/overlay_picture.h"
#include "capture/raw_frame.h"
#include "core/ray_scene.h"
#include "core/sample_map.h"

namespace scattermeter::apps {

// Of the marks, for the legend.
inline constexpr Rgb8 kClippedColour = {213, 0, 50};

// The object and a tenth of it around as the bytes of a PNG about `width_px` wide: grey light, the
// mesh's visible edges in the colours of overlay_picture.h, a dot on every clipped sample of the
// map's rectangle (on some of them, where they are thousands).
std::string shot_picture(const capture::RawFrame& frame, const CameraView& view,
                         const RayScene& scene, const SampleMap& map, int width_px);

}  // namespace scattermeter::apps
