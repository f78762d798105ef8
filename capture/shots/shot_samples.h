// The samples of a shot, corrected by a radiance calibration if there is one.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "capture/raw/raw_frame.h"
#include "capture/shots/shot_decoding.h"
#include "core/scene/observed_shot.h"

namespace scattermeter::capture {

// A shot in counts of its first exposure.
struct ShotSamples {
  CfaSamples samples;
  std::vector<ShotExposure> exposures;  // one, or those of a bracket
  // Mean counts of the frame for each colour, of which glare is a share; in a bracket that of the
  // shortest exposure, which clips least. 0 without camera.radiance.
  std::array<double, kRgb> frame_mean_counts{};
};

// A rectangle of a shot: frame_samples() of each of its exposures, merged by merged_samples().
// `frames` and `names` (for messages) are those of shot.files(), in the same order. Throws
// InputError, too, for a bracket whose files differ in size, camera, filters, ISO or aperture
// (values that a file does not state are not compared).
ShotSamples shot_samples(const Scene& scene, const ShotDecoding& decoding, const SceneShot& shot,
                         const std::vector<RawFrame>& frames, const std::vector<std::string>& names,
                         int x0, int y0, int width, int height);

}  // namespace scattermeter::capture
