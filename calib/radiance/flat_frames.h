// Flats of a radiance calibration, reduced to block means and the noise of pairs.
#pragma once

#include <cstddef>
#include <vector>

#include "calib/radiance/frame_blocks.h"
#include "calib/radiance/radiance_steps.h"

namespace scattermeter::calib {

inline constexpr double kLeastFlatCounts = 20.0;  // of a block, for linearity

// The blocks of one flat.
struct FlatBlocks {
  const RadianceShot* shot;
  std::size_t setting = 0;       // index into FlatFrames::settings_s
  std::size_t lamp = 0;          // index into FlatFrames::lamps
  std::vector<BlockMean> means;  // one per block
};

// The noise of one block in a pair of frames.
struct TransferPoint {
  PairVariance pair;
  double quantisation_counts2;  // part of the variance, from rounding
  std::size_t colour;
};

struct FlatFrames {
  std::vector<FlatBlocks> shots;
  std::vector<double> settings_s;       // different exposure times, to within 1e-3
  std::vector<double> lamps;            // different values of RadianceShot::lamp
  std::vector<TransferPoint> transfer;  // of pairs of flats and of dark frames
  double range_counts = 0;              // from black to the lowest clip level
  bool dark_pairs = false;              // there is a pair of dark frames
};

// Opens the flats, then the dark frames, and pairs those of equal exposure time and lamp: each
// frame with an earlier one that has no partner yet. Sets blocks and cfa of `steps` and adds a note
// for each flat without a partner. Throws InputError for flats that are clipped or dark in half of
// the frame, if there is no pair of flats, and for fewer than three exposure times.
FlatFrames open_flats(RadianceSteps& steps);

}  // namespace scattermeter::calib
