// The shots of a true setup.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/deviations/colour_frame.h"
#include "apps/deviations/deviation.h"
#include "apps/deviations/unit_pictures.h"
#include "capture/raw/raw_frame.h"

namespace scattermeter::apps {

struct ExpectedShots {
  std::vector<ColourFrame> frames;  // counts above black of each shot
  double exposure_s = 0;            // of all shots
  // Variance per count of the signal that the Monte Carlo of a volume rendering adds to that of the
  // photons, in the mean over a patch: of each shot and channel, and the largest.
  std::vector<std::array<double, 3>> noise_counts2_per_count;
  double rendering_counts2_per_count = 0;
};

// One exposure time is chosen for all shots, so that the brightest pixel of the object reaches
// three quarters of the range that `stated` has. Throws InputError for what cannot be rendered.
ExpectedShots expected_shots(const TrueSetup& setup, const Rig& stated, bool volume,
                             UnitPictures& pictures);

// The raw frames that the true sensor makes of them, with noise (that of the rendering brought to
// the largest of all shots and channels), and with black and white level,
// colour filters and settings as the stated camera writes them to its files.
std::vector<capture::RawFrame> exposed_frames(const ExpectedShots& shots, const TrueSetup& setup,
                                              const Rig& stated, std::uint64_t seed);

}  // namespace scattermeter::apps
