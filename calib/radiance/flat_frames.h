// The flats of a radiance calibration, reduced to means of blocks and the noise of pairs.
#pragma once

#include <cstddef>
#include <vector>

#include "calib/radiance/frame_blocks.h"
#include "calib/radiance/radiance_steps.h"

namespace scattermeter::calib {

inline constexpr double kLeastFlatCounts = 20.0;  // of a block, for linearity

// One flat's blocks.
struct FlatBlocks {
  const RadianceShot* shot;
  std::size_t setting = 0;       // of FlatFrames::settings_s
  std::size_t lamp = 0;          // of FlatFrames::lamps
  std::vector<BlockMean> means;  // one per block
};

// The noise of one block in a pair of frames.
struct TransferPoint {
  PairVariance pair;
  double quantisation_counts2;  // of its variance, from rounding
  std::size_t colour;
};

struct FlatFrames {
  std::vector<FlatBlocks> shots;
  std::vector<double> settings_s;       // exposure times, equal ones within 1e-3 once
  std::vector<double> lamps;            // RadianceShot::lamp, equal ones once
  std::vector<TransferPoint> transfer;  // of pairs of flats and of dark frames
  double range_counts = 0;              // from black to the lowest clip level
  bool dark_pairs = false;              // there is one
};

// Opens the flats, then the dark frames, and pairs those of equal exposure time and lamp: each
// frame with the one before that has no partner yet. Sets blocks and cfa of `steps` and adds a note
// for each flat without a partner. Throws InputError for flats that are clipped or dark in half of
// the frame, for no pair of flats, and for fewer than three exposure times.
FlatFrames open_flats(RadianceSteps& steps);

}  // namespace scattermeter::calib
