#include "capture/sensor/saturation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace scattermeter::capture {
namespace {

constexpr std::size_t kValues = 65536;
using Histogram = std::vector<std::size_t>;  // samples per value

std::array<Histogram, 4> histograms(const RawFrame& frame) {
  std::array<Histogram, 4> counts;
  counts.fill(Histogram(kValues, 0));
  const auto width = static_cast<std::size_t>(frame.width_px);
  for (std::size_t y = 0; y < static_cast<std::size_t>(frame.height_px); ++y) {
    const std::uint16_t* row = &frame.samples[y * width];
    for (std::size_t x = 0; x < width; ++x) ++counts[2 * (y % 2) + x % 2][row[x]];
  }
  return counts;
}

std::size_t largest_value(const Histogram& histogram) {
  std::size_t value = kValues - 1;
  while (value > 0 && histogram[value] == 0) --value;
  return value;
}

// A pile-up at m with n samples has few samples above it (a, outliers such as a defect pixel) and
// exceeds the most frequent of the few values just below it (b samples). The rule requires
//  - n - b > 6 sqrt(n + b), the standard deviation of the difference being at most sqrt(n + b), so
//    that n > 36 whatever b, and
//  - a <= (n - b) / 16.
// Noise alone does not satisfy the second one. Of normally distributed samples with a standard
// deviation of 0.53 values or more (see shows_noise) at least 0.27 (n - b) lie above m, wherever
// the mean is; numbers of samples add, so that this holds for every mixture of such distributions,
// which the histogram of any noisy scene is. Where it holds, the two conditions together require
// that n - b exceeds its expectation by more than six standard deviations, once in 10^9 cases. A
// candidate has 16 times as many samples as all of those above it, so that a phase of 10 megapixels
// has five at most: with four phases, one false alarm in 10^7 frames.
// Values that do not occur are skipped (gaps of a curve, a 12-bit camera in a 14-bit file). A
// pile-up far below the white level is due to the scene, so m must reach a quarter of the white
// level. Not found is a pile-up that spreads over several values.
constexpr std::size_t kValuesBeneath = 8;
constexpr double kSigmas = 6.0;
constexpr double kMaxOutliersOfPile = 1.0 / 16;
constexpr double kMinFractionOfWhite = 0.25;

std::size_t fullest_beneath(const Histogram& histogram, std::size_t value) {
  std::size_t fullest = 0;
  for (std::size_t met = 0; value-- > 0 && met < kValuesBeneath;) {
    fullest = std::max(fullest, histogram[value]);
    met += histogram[value] > 0 ? 1 : 0;
  }
  return fullest;
}

// The highest value below `nominal` at which samples pile up.
std::optional<std::size_t> pile_up(const Histogram& histogram, double nominal,
                                   double white_counts) {
  double above = 0;  // samples
  for (std::size_t value = kValues - 1;
       static_cast<double>(value) >= kMinFractionOfWhite * white_counts && value > 0; --value) {
    const auto n = static_cast<double>(histogram[value]);
    if (n > 0.0 && static_cast<double>(value) < nominal && above <= kMaxOutliersOfPile * n) {
      const auto b = static_cast<double>(fullest_beneath(histogram, value));
      if (n - b > kSigmas * std::sqrt(n + b) && above <= kMaxOutliersOfPile * (n - b)) {
        return value;
      }
    }
    above += n;
  }
  return std::nullopt;
}

// The rank of each value among the values that occur in the phase.
std::vector<int> ranks(const Histogram& histogram) {
  std::vector<int> rank(kValues, 0);
  int next = 0;
  for (std::size_t value = 0; value < kValues; ++value) {
    rank[value] = histogram[value] > 0 ? next++ : next;
  }
  return rank;
}

// Whether the frame shows noise below the pile-up. A frame computed without noise piles up wherever
// the scene is uniform, so the histogram alone is not sufficient. Three consecutive samples of a
// phase, all below the pile-up and not dark, give the second difference d = a - 2 b + c of their
// ranks. In a smooth scene without noise, d is due to rounding: |d| >= 2 is rare (5 % at most). In
// a piecewise uniform scene (facets of a mesh), mostly d = 0. Noise with a standard deviation of s
// ranks makes d normal with a standard deviation of sqrt(6) s, rounded: from s = 0.53 on, |d| >= 2
// for at least a quarter of the triples and d = 0 for less than a third. Photon noise at an eighth
// of a pile-up at 2048 counts is larger than that up to 900 electrons per count. With too few such
// triples (all samples clipped or dark) nothing can be concluded, and the result is false.
constexpr std::size_t kMinTriples = 64;
constexpr double kMinRoughFraction = 0.25;
constexpr double kMaxEvenFraction = 1.0 / 3;
constexpr double kMinFractionOfPile = 0.125;  // "not dark" is above this share of the pile-up

bool shows_noise(const RawFrame& frame, const std::array<Histogram, 4>& counts,
                 const std::array<std::size_t, 4>& top_values) {
  std::array<std::vector<int>, 4> rank;
  std::transform(counts.begin(), counts.end(), rank.begin(), ranks);
  std::size_t triples = 0;
  std::size_t rough = 0;
  std::size_t even = 0;
  const auto width = static_cast<std::size_t>(frame.width_px);
  for (std::size_t y = 0; y < static_cast<std::size_t>(frame.height_px); ++y) {
    const std::uint16_t* row = &frame.samples[y * width];
    for (std::size_t x = 0; x + 4 < width; ++x) {
      const std::size_t phase = 2 * (y % 2) + x % 2;
      const std::size_t top = top_values[phase];
      const std::array<std::size_t, 3> v = {row[x], row[x + 2], row[x + 4]};
      if (v[0] >= top || v[1] >= top || v[2] >= top) continue;
      const double black = frame.black_counts[phase];
      const double dark = black + kMinFractionOfPile * (static_cast<double>(top) - black);
      if (static_cast<double>(v[1]) < dark) continue;
      ++triples;
      const int second = rank[phase][v[0]] - 2 * rank[phase][v[1]] + rank[phase][v[2]];
      rough += std::abs(second) >= 2 ? 1 : 0;
      even += second == 0 ? 1 : 0;
    }
  }
  const auto n = static_cast<double>(triples);
  return triples >= kMinTriples && static_cast<double>(rough) >= kMinRoughFraction * n &&
         static_cast<double>(even) <= kMaxEvenFraction * n;
}

}  // namespace

std::array<double, 4> clip_levels(const RawFrame& frame) {
  double nominal = frame.white_counts;
  if (!frame.curve_levels.empty()) {
    nominal = std::min(nominal, static_cast<double>(frame.curve_levels.back()));
  }
  std::array<double, 4> clip{};
  clip.fill(nominal);
  if (frame.samples.empty()) return clip;

  const std::array<Histogram, 4> counts = histograms(frame);
  std::array<std::size_t, 4> top{};
  std::array<bool, 4> pile{};
  for (std::size_t phase = 0; phase < 4; ++phase) {
    const std::optional<std::size_t> found = pile_up(counts[phase], nominal, frame.white_counts);
    pile[phase] = found.has_value();
    top[phase] = found.value_or(largest_value(counts[phase]));
  }
  if (std::none_of(pile.begin(), pile.end(), [](bool p) { return p; })) return clip;
  if (!shows_noise(frame, counts, top)) return clip;
  for (std::size_t phase = 0; phase < 4; ++phase) {
    if (pile[phase]) clip[phase] = static_cast<double>(top[phase]);
  }
  return clip;
}

}  // namespace scattermeter::capture
