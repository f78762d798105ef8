// The shots of a true setup.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/deviations/colour_frame.h"
#include "apps/deviations/deviation.h"
#include "apps/deviations/unit_pictures.h"
#include "capture/raw/raw_frame.h"

namespace scattermeter::apps {

// Expected counts above black of each shot. One exposure time is chosen for all, so that the
// brightest pixel of the object reaches three quarters of the range that `stated` has; it is
// returned in exposure_s. Throws InputError for what cannot be rendered.
std::vector<ColourFrame> expected_frames(const TrueSetup& setup, const Rig& stated, bool volume,
                                         UnitPictures& pictures, double& exposure_s);

// The raw frames that the true sensor makes of them, with noise, and with black and white level,
// colour filters and settings as the stated camera writes them to its files.
std::vector<capture::RawFrame> exposed_frames(const std::vector<ColourFrame>& frames,
                                              const TrueSetup& setup, const Rig& stated,
                                              double exposure_s, std::uint64_t seed);

}  // namespace scattermeter::apps
