// Small picture of a shot with the edges of the mesh and clipped samples marked.
#pragma once

#include <string>

#include "apps/report/overlay_picture.h"
#include "capture/raw/raw_frame.h"
#include "core/mesh/ray_scene.h"
#include "core/view/camera_view.h"
#include "core/view/sample_map.h"

namespace scattermeter::apps {

// The colour of clipped samples, for the legend.
inline constexpr Rgb8 kClippedColour = {213, 0, 50};

// The bytes of a PNG about `width_px` wide that shows the object with a margin of a tenth: the
// light in grey, the visible edges of the mesh in the colours of overlay_picture.h, and a dot on
// every clipped sample in the rectangle of the map (on a subset if there are thousands).
std::string shot_picture(const capture::RawFrame& frame, const CameraView& view,
                         const RayScene& scene, const SampleMap& map, int width_px);

// The same at the width of a figure on a page.
std::string shot_thumbnail(const capture::RawFrame& frame, const CameraView& view,
                           const RayScene& scene, const SampleMap& map);

}  // namespace scattermeter::apps
