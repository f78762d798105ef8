// bench atlas: light between the atlas's nodes against paths of the very medium.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/material/medium.h"

namespace scattermeter::apps {

struct AtlasInterpolationOptions {
  std::vector<std::string> bodies = {"cube"};  // names of core/mesh/bodies.h
  int media = 6;                               // of each body, >= 1
  std::int64_t paths = 400'000;  // of each medium alone, and for it in the atlas, >= 32768
  double g = 0.0;
  int image_width_px = 968;
  std::uint64_t seed = 1;
  Progress* progress = nullptr;
};

// How the light of some groups of patches differs, relative to the image's mean. The paths of atlas
// and medium are divided into independent halves: the products of the two halves' differences have
// the squared interpolation error as their mean, without any share of the Monte Carlo error, and
// may be negative.
struct AtlasDifference {
  int groups = 0;
  double mean_square = 0;  // of the interpolation error, relative^2
  double monte_carlo = 0;  // root mean square of the Monte Carlo error of the mean of both halves
  // The difference, as one half shows it, of the group for which it is largest in the other: mean
  // over both. No larger than the largest interpolation error in the mean; its Monte Carlo error is
  // about `monte_carlo`.
  double largest = 0;
};

struct AtlasInterpolationRow {
  std::string body;
  Medium medium;
  std::int64_t paths = 0;        // of the medium alone
  std::int64_t atlas_paths = 0;  // as many paths of the medium would have the atlas's errors
  AtlasDifference patches;
  AtlasDifference cells;  // some dozens of patches each (core/fit/shot_parts.h)
};

// On patches of 1 mm, at random media, sigma_s' of 0.2 to 10 per mm and 1 - albedo' of 3e-4 to 0.5,
// each evenly in its logarithm. The same seed draws the same media for every body, and more of them
// begin with the same ones.
std::vector<AtlasInterpolationRow> atlas_interpolation(const AtlasInterpolationOptions& options);

// At five nodes, sigma_s' of 0.35 to 5.8 per mm, between which lie further ones: their light
// against that interpolated from the first and third on either side, at twice the usual spacing,
// whose error is 2^4 times as large as the usual one and so stands out of the Monte Carlo error.
// Differences are divided by 2^4. paths: of each node. media is not used.
std::vector<AtlasInterpolationRow> atlas_interpolation_of_nodes(
    const AtlasInterpolationOptions& options);

// Of the rows of one body: the root mean square over media, its upper limit of 95 %, both relative.
struct AtlasInterpolationError {
  double rms = 0;  // 0 where the mean square is negative
  double below = 0;
};
AtlasInterpolationError interpolation_error(const std::vector<double>& mean_squares);

std::string atlas_interpolation_table(const std::vector<AtlasInterpolationRow>& rows);
std::string atlas_interpolation_csv(const std::vector<AtlasInterpolationRow>& rows);

}  // namespace scattermeter::apps
