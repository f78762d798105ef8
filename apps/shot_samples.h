// The samples of a shot, through whatever calibration the rig has.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/rig.h"
#include "capture/corrected_samples.h"
#include "capture/exposure_departure.h"
#include "capture/raw_frame.h"

namespace scattermeter::apps {

// A rectangle of the frame: capture::corrected_samples() with camera.radiance, else
// capture::linear_samples() with camera.sensor (what shots share is then 0). Throws InputError,
// naming `file`, for a frame that the calibration does not hold for.
capture::CorrectedSamples frame_samples(const Rig& rig, const capture::RawFrame& frame,
                                        const std::string& file, int x0, int y0, int width,
                                        int height);

// One exposure of a shot.
struct ShotExposure {
  std::string file;             // as in the rig
  double stated_s = 0;          // by the file
  double true_s = 0;            // by camera.radiance; without it the stated time counts as exact
  double relative_std = 0;      // of true_s
  double black_std_counts = 0;  // of this file's black, common to its samples
  capture::ExposureDeparture departure = {};  // in a bracket: from the others
};

// A shot in counts of its first exposure.
struct ShotSamples {
  CfaSamples samples;
  std::vector<ShotExposure> exposures;  // one, or those of the bracket
  // Mean of the frame's counts per colour, of which glare is a share: in a bracket that of the
  // shortest exposure, which clips least. 0 without camera.radiance.
  std::array<double, kRgb> frame_mean_counts{};
};

// A rectangle of a shot: frame_samples() of each of its exposures, merged by
// capture::merged_samples(). frames: of shot.files(), in their order; names: of the same, for
// messages. Throws InputError, too, for a bracket whose files differ in size, camera, filters, ISO
// or aperture (what a file does not state is not compared).
ShotSamples shot_samples(const Rig& rig, const RigShot& shot,
                         const std::vector<capture::RawFrame>& frames,
                         const std::vector<std::string>& names, int x0, int y0, int width,
                         int height);

}  // namespace scattermeter::apps
