#include "calib/radiance/flat_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "capture/sensor/noise_model.h"
#include "capture/sensor/saturation.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {
namespace {

constexpr int kBlockSide_px = 16;

// Index of the value in the list, to which it is added unless an equal value is in it.
template <typename Same>
std::size_t index_in(std::vector<double>& list, double value, const Same& same) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (same(list[i], value)) return i;
  }
  list.push_back(value);
  return list.size() - 1;
}

// The variance of a sample due to rounding alone, for each value: the noise model of a sensor
// without any other noise. Empty: 1/12 everywhere.
std::vector<double> quantisation_table(const capture::RawFrame& frame) {
  if (frame.curve_levels.empty()) return {};
  capture::RawFrame scale;
  scale.curve_levels = frame.curve_levels;
  const capture::NoiseModel model({1e12, 0.0}, scale);
  std::vector<double> out(65536);
  for (std::size_t v = 0; v < out.size(); ++v) {
    out[v] = model.variance_counts2(static_cast<std::uint16_t>(v), 0);
  }
  return out;
}

void add_pair(const RadianceSteps& steps, const capture::RawFrame& a, const capture::RawFrame& b,
              FlatFrames& flats) {
  const capture::RadianceCorrection& c = steps.calibration.correction;
  std::vector<std::uint8_t> marks = marks_of(a, c);
  const std::vector<std::uint8_t> other = marks_of(b, c);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (other[i] == kSampleClipped) marks[i] = kSampleClipped;
  }
  // Dark current counts as light here, since its electrons have the same shot noise.
  const std::array<double, 4>& black = c.black_counts;
  const std::vector<PairVariance> pairs =
      pair_variances(a.samples, b.samples, marks, a.width_px, black, steps.blocks);
  const std::vector<double> table = quantisation_table(a);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (pairs[k].n == 0) continue;
    const auto phase = static_cast<std::size_t>(steps.blocks[k].phase);
    const double value = pairs[k].counts + black[phase];
    const double q = table.empty()
                         ? 1.0 / 12.0
                         : table[static_cast<std::size_t>(std::clamp(value, 0.0, 65535.0))];
    flats.transfer.push_back({pairs[k], q, static_cast<std::size_t>(a.cfa.phase[phase])});
  }
}

// Pairs every second dark frame of an exposure time with the one before, for the read noise.
void open_dark_pairs(RadianceSteps& steps, FlatFrames& flats) {
  std::optional<capture::RawFrame> last;
  for (const RadianceShot& shot : steps.input.shots.dark) {
    capture::RawFrame frame = open_radiance_shot(steps, shot);
    if (last && std::abs(last->exposure_s - frame.exposure_s) <= 1e-3 * frame.exposure_s) {
      add_pair(steps, *last, frame, flats);
      flats.dark_pairs = true;
      last.reset();
    } else {
      last = std::move(frame);
    }
  }
}

void check_flat(const RadianceShot& shot, const std::vector<BlockMean>& means) {
  const auto whole = static_cast<double>(means.size());
  double clipped = 0, dark = 0;
  for (const BlockMean& m : means) {
    clipped += m.n == 0 ? 1.0 : 0.0;
    dark += m.n > 0 && m.counts < kLeastFlatCounts ? 1.0 : 0.0;
  }
  if (clipped > 0.5 * whole) {
    throw InputError(shot.file, fmt::format("flat: clipped in {:.0f} % of the frame, limit 50 %; "
                                            "expose shorter or dim the lamp",
                                            100.0 * clipped / whole));
  }
  if (dark > 0.5 * whole) {
    throw InputError(
        shot.file, fmt::format("flat: below {:.0f} counts in {:.0f} % of the frame; expose longer",
                               kLeastFlatCounts, 100.0 * dark / whole));
  }
}

void choose_blocks(const capture::RawFrame& frame, RadianceSteps& steps, FlatFrames& flats) {
  steps.cfa = frame.cfa;
  steps.blocks = blocks_of_frame(frame.width_px, frame.height_px,
                                 std::clamp(frame.width_px / kBlockSide_px, 2, 24),
                                 std::clamp(frame.height_px / kBlockSide_px, 2, 16));
  const std::array<double, 4> clip = capture::clip_levels(frame);
  flats.range_counts = 1e9;
  for (std::size_t p = 0; p < 4; ++p) {
    flats.range_counts =
        std::min(flats.range_counts, clip[p] - steps.calibration.correction.black_counts[p]);
  }
}

FlatBlocks reduce(const RadianceShot& shot, const capture::RawFrame& frame,
                  const RadianceSteps& steps, FlatFrames& flats) {
  const capture::RadianceCorrection& c = steps.calibration.correction;
  FlatBlocks flat{&shot, 0, 0, {}};
  flat.setting = index_in(flats.settings_s, frame.exposure_s,
                          [](double a, double b) { return std::abs(a - b) <= 1e-3 * a; });
  flat.lamp = index_in(flats.lamps, shot.lamp, [](double a, double b) { return a == b; });
  flat.means = block_means(frame.samples, marks_of(frame, c), frame.width_px,
                           black_at(c, frame.exposure_s), steps.blocks);
  check_flat(shot, flat.means);
  return flat;
}

}  // namespace

FlatFrames open_flats(RadianceSteps& steps) {
  FlatFrames flats;
  std::map<std::pair<std::size_t, std::size_t>, capture::RawFrame> waiting;
  const std::string where =
      steps.input.shots.at(steps.input.shots.line) + ": calibration.radiance.flats";
  std::size_t flat_pairs = 0;
  for (const RadianceShot& shot : steps.input.shots.flats) {
    capture::RawFrame frame = open_radiance_shot(steps, shot);
    if (steps.blocks.empty()) choose_blocks(frame, steps, flats);
    flats.shots.push_back(reduce(shot, frame, steps, flats));
    const auto key = std::make_pair(flats.shots.back().setting, flats.shots.back().lamp);
    if (const auto other = waiting.find(key); other != waiting.end()) {
      add_pair(steps, other->second, frame, flats);
      ++flat_pairs;
      waiting.erase(other);
    } else {
      waiting.emplace(key, std::move(frame));
    }
  }
  if (flat_pairs == 0) {
    throw InputError(where, fmt::format("no two flats of equal exposure time and lamp among {}: "
                                        "the noise is measured from the difference of a pair",
                                        flats.shots.size()));
  }
  for (const auto& [key, frame] : waiting) {
    steps.calibration.notes.push_back(fmt::format(
        "the flat of {:.4g} s has no partner: it is used for the linearity, not for the noise",
        frame.exposure_s));
  }
  if (flats.settings_s.size() < 3) {
    throw InputError(where,
                     fmt::format("{} exposure time{}: linearity and times need at least "
                                 "three, over a factor of ten",
                                 flats.settings_s.size(), flats.settings_s.size() == 1 ? "" : "s"));
  }
  open_dark_pairs(steps, flats);
  return flats;
}

}  // namespace scattermeter::calib
