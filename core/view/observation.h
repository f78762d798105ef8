// The radiosity of each visible patch as observed in one shot.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/camera/cfa_samples.h"
#include "core/view/sample_map.h"

namespace scattermeter {

// Why a patch is not used in a channel.
enum class RowState : unsigned char {
  kUsed = 0,
  kNoSamples,  // no sample of the channel falls on it
  kClipped,    // at least one of its samples is clipped
  kFloor,      // so dark that the camera clips its noise at zero
  kMirror,     // mirrors a light into the camera; of a rough object: much of it
  kNoise,      // its expected light does not exceed the noise
  kOutlier,    // inconsistent with the other rows: dust, a scratch, a mark
  kEdge,       // beside a silhouette, a step or a crease, for a model of whole patches
};
inline constexpr std::size_t kRowStates = 8;

// One exposure of a bracket, in one channel.
struct ExposurePart {
  std::vector<double> of_row;  // share of the row's l that comes from it
  std::size_t samples = 0;     // samples in rows to which it contributes
};

// One channel of a shot: l_j = pi L_o / Ft (paper eq. 11), a cubic fitted to the channel's
// samples on the patch and its neighbours, averaged over the positions of the samples of all
// channels on the patch (those that SampleMap::mean_mm and spread_mm2 describe;
// core/view/row_mean.h).
struct ChannelObservation {
  std::vector<double> l;         // per row, W/mm^2 for known responsivity, else up to one factor
  std::vector<double> variance;  // of l, from the samples' variances
  std::vector<double> variance_per_l;  // growth of the variance with l (photon noise), W/mm^2
  std::vector<double> l_per_count;     // change of l with one count more in every sample, W/mm^2
  std::vector<RowState> state;
  std::size_t rows_used = 0;
  std::size_t rows_clipped = 0;
  std::size_t rows_floor = 0;
  std::size_t samples = 0;  // in rows
  std::size_t samples_clipped = 0;
  double brightest_counts = 0;  // largest row mean, counts above black
  double brightest_snr = 0;     // largest l / std over rows, by the stated noise
  // Variance of the samples' noise, by the squared second differences of neighbours of one filter
  // phase, over what their variances say, where it is above 1.3 and six standard deviations above
  // 1; else 1. The variances above have been multiplied by it.
  double noise_excess = 1;
  std::vector<ExposurePart> exposures;  // for a bracket, in its order; else empty
};

struct Observation {
  std::array<ChannelObservation, kRgb> channel;
};

// A clipped sample excludes its whole row, a defective one only itself.
// responsivity: counts per (W/(mm^2 sr)) and second, per channel, > 0.
// Preconditions (std::invalid_argument): the rectangles of map and samples agree, exposure > 0.
Observation observe(const CfaSamples& samples, const SampleMap& map,
                    const std::array<double, kRgb>& responsivity_counts_mm2_sr_per_W_s);

}  // namespace scattermeter
