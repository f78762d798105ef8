// Flats: photon transfer, linearity, exposure times.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "calib/radiance/photon_transfer.h"
#include "calib/radiance/radiance_steps.h"
#include "capture/sensor/noise_model.h"
#include "capture/sensor/saturation.h"
#include "core/base/covariance_root.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {
namespace {

constexpr double kLeastCounts = 20.0;  // of a block, for linearity
constexpr double kMostOfRange = 0.95;  // of a block: its noise must not reach the clip
constexpr double kTransferTop = 0.8;   // of the range, for the photon transfer
constexpr int kBlockSide_px = 16;

// One flat's blocks.
struct FlatBlocks {
  const RadianceShot* shot;
  std::size_t setting = 0, lamp = 0;
  std::vector<BlockMean> means;
};

struct TransferPoint {
  PairVariance pair;
  double quantisation_counts2;
  std::size_t colour;
};

struct Flats {
  std::vector<FlatBlocks> shots;
  std::vector<double> settings_s, lamps;
  std::vector<TransferPoint> transfer;  // of pairs of flats and of dark frames
  double range_counts = 0;
  std::size_t flat_pairs = 0;
  bool dark_pairs = false;
};

template <typename Same>
std::size_t place_of(std::vector<double>& list, double value, const Same& same) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (same(list[i], value)) return i;
  }
  list.push_back(value);
  return list.size() - 1;
}

// What rounding alone adds to a sample's variance, by value: the noise model of a sensor without
// any other noise. Empty: 1/12 everywhere.
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
              Flats& flats) {
  const capture::RadianceCorrection& c = steps.calibration.correction;
  std::vector<std::uint8_t> marks = marks_of(a, c);
  const std::vector<std::uint8_t> other = marks_of(b, c);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (other[i] == kSampleClipped) marks[i] = kSampleClipped;
  }
  // Dark current counts as light here: its electrons make noise as any.
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

// Every second dark frame of one exposure with the one before: the read noise.
void open_dark_pairs(RadianceSteps& steps, Flats& flats) {
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
    dark += m.n > 0 && m.counts < kLeastCounts ? 1.0 : 0.0;
  }
  if (clipped > 0.5 * whole) {
    throw InputError(shot.file, fmt::format("flat: clipped in {:.0f} % of the frame, limit 50 %; "
                                            "expose shorter or dim the lamp",
                                            100.0 * clipped / whole));
  }
  if (dark > 0.5 * whole) {
    throw InputError(
        shot.file, fmt::format("flat: below {:.0f} counts in {:.0f} % of the frame; expose longer",
                               kLeastCounts, 100.0 * dark / whole));
  }
}

Flats open_flats(RadianceSteps& steps) {
  Flats flats;
  const capture::RadianceCorrection& c = steps.calibration.correction;
  std::map<std::pair<std::size_t, std::size_t>, capture::RawFrame> waiting;
  for (const RadianceShot& shot : steps.input.shots.flats) {
    capture::RawFrame frame = open_radiance_shot(steps, shot);
    if (steps.blocks.empty()) {
      steps.cfa = frame.cfa;
      steps.blocks = blocks_of_frame(frame.width_px, frame.height_px,
                                     std::clamp(frame.width_px / kBlockSide_px, 2, 24),
                                     std::clamp(frame.height_px / kBlockSide_px, 2, 16));
      const std::array<double, 4> clip = capture::clip_levels(frame);
      flats.range_counts = 1e9;
      for (std::size_t p = 0; p < 4; ++p) {
        flats.range_counts = std::min(flats.range_counts, clip[p] - c.black_counts[p]);
      }
    }
    FlatBlocks flat{&shot, 0, 0, {}};
    flat.setting = place_of(flats.settings_s, frame.exposure_s,
                            [](double a, double b) { return std::abs(a - b) <= 1e-3 * a; });
    flat.lamp = place_of(flats.lamps, shot.lamp, [](double a, double b) { return a == b; });
    flat.means = block_means(frame.samples, marks_of(frame, c), frame.width_px,
                             black_at(c, frame.exposure_s), steps.blocks);
    check_flat(shot, flat.means);
    const auto key = std::make_pair(flat.setting, flat.lamp);
    if (const auto other = waiting.find(key); other != waiting.end()) {
      add_pair(steps, other->second, frame, flats);
      ++flats.flat_pairs;
      waiting.erase(other);
    } else {
      waiting.emplace(key, std::move(frame));
    }
    flats.shots.push_back(std::move(flat));
  }
  if (flats.flat_pairs == 0) {
    throw InputError(steps.input.shots.at(steps.input.shots.line) + ": calibration.radiance.flats",
                     fmt::format("no two flats of equal exposure time and lamp among {}: the noise "
                                 "is measured from the difference of a pair",
                                 flats.shots.size()));
  }
  for (const auto& [key, frame] : waiting) {
    steps.calibration.notes.push_back(
        fmt::format("the flat of {:.4g} s stands alone: it serves the linearity, not the noise",
                    frame.exposure_s));
  }
  if (flats.settings_s.size() < 3) {
    throw InputError(
        steps.input.shots.at(steps.input.shots.line) + ": calibration.radiance.flats",
        fmt::format("{} exposure time{}: linearity and times need at least three, over a factor of "
                    "ten",
                    flats.settings_s.size(), flats.settings_s.size() == 1 ? "" : "s"));
  }
  return flats;
}

// Photon transfer of each colour on counts made linear by the curve.
std::array<PhotonTransfer, kRgb> transfer_of(const RadianceSteps& steps, const Flats& flats,
                                             const ResponseCurve& curve) {
  std::array<std::vector<NoisePoint>, kRgb> points;
  for (const TransferPoint& t : flats.transfer) {
    if (t.pair.counts > kTransferTop * flats.range_counts) continue;
    const double g = curve.gain_at(t.pair.counts);
    points[t.colour].push_back({curve.light_counts(t.pair.counts), g * g * t.pair.variance_counts2,
                                g * g * t.quantisation_counts2, static_cast<double>(t.pair.n - 1)});
  }
  std::array<PhotonTransfer, kRgb> out;
  for (std::size_t c = 0; c < kRgb; ++c) {
    out[c] = fit_photon_transfer(points[c]);
    if (!out[c].ok) {
      throw InputError(
          steps.input.shots.at(steps.input.shots.line) + ": calibration.radiance.flats",
          fmt::format("channel {}: the noise of {} blocks does not grow with the light; are the "
                      "pairs two exposures, and raws?",
                      kRgbName[c], points[c].size()));
    }
  }
  return out;
}

}  // namespace

void find_response_and_noise(RadianceSteps& steps) {
  capture::RadianceCalibration& calibration = steps.calibration;
  capture::RadianceCorrection& correction = calibration.correction;
  Flats flats = open_flats(steps);
  open_dark_pairs(steps, flats);
  if (!flats.dark_pairs) {
    calibration.notes.emplace_back(
        "no two dark frames of equal exposure time: the read noise rests on the flats alone");
  }
  const std::array<PhotonTransfer, kRgb> rough = transfer_of(steps, flats, {});

  std::vector<FlatSample> samples;
  std::vector<FlatShot> shots;
  const std::size_t n_blocks = steps.blocks.size();
  std::vector<double> n_of_place(n_blocks * flats.lamps.size(), 0.0);
  for (const FlatBlocks& flat : flats.shots) {
    for (std::size_t k = 0; k < n_blocks; ++k) {
      const BlockMean& m = flat.means[k];
      if (m.n == 0 || m.counts < kLeastCounts || m.counts > kMostOfRange * flats.range_counts) {
        continue;
      }
      const auto phase = static_cast<std::size_t>(steps.blocks[k].phase);
      const PhotonTransfer& noise = rough[static_cast<std::size_t>(steps.cfa.phase[phase])];
      const double dark =
          std::max(noise.read_noise_counts * noise.read_noise_counts, 0.01) + 1. / 12;
      samples.push_back({shots.size(), flat.lamp * n_blocks + k, m.counts, dark / m.n,
                         1.0 / (noise.gain_e_per_count * m.n)});
      n_of_place[samples.back().place] = m.n;
    }
    shots.push_back({flat.setting});
  }
  ResponseFitOptions options;
  options.black_std_counts = correction.black_std_counts;
  const ResponseFit fit =
      fit_response(samples, shots, flats.settings_s, n_of_place.size(), options);
  if (!fit.ok) {
    throw InputError(
        steps.input.shots.at(steps.input.shots.line) + ": calibration.radiance.flats",
        "linearity: too few blocks are neither clipped nor dark in three exposure times; step the "
        "times more finely");
  }
  steps.settings_s = flats.settings_s;
  steps.response_covariance = fit.joint_covariance;
  steps.shot_std = fit.shot_std;
  // One converter: all colours share the curve.
  for (std::size_t c = 0; c < kRgb; ++c) {
    correction.response[c] = fit.curve;
    const Eigen::MatrixXd& v = fit.curve_covariance;
    calibration.response_covariance[c].assign(v.data(), v.data() + v.size());
    correction.response_std[c] = std::sqrt(v(v.rows() - 1, v.cols() - 1));
  }
  double squares = 0;
  for (std::size_t s = 0; s < flats.settings_s.size(); ++s) {
    const auto i = static_cast<Eigen::Index>(s);
    const double log_ratio = fit.log_true_over_stated[i];
    squares += log_ratio * log_ratio;
    correction.shutter.push_back(
        {flats.settings_s[s], std::exp(log_ratio),
         std::hypot(std::sqrt(fit.setting_covariance(i, i)), fit.shot_std)});
  }
  std::sort(correction.shutter.begin(), correction.shutter.end(),
            [](const auto& a, const auto& b) { return a.stated_s < b.stated_s; });
  correction.shutter_relative_std = std::hypot(
      std::sqrt(squares / static_cast<double>(flats.settings_s.size() - 1)), fit.shot_std);
  const std::array<PhotonTransfer, kRgb> transfer = transfer_of(steps, flats, fit.curve);
  double worst_transfer = 0, transfer_chi2 = 0;
  for (std::size_t c = 0; c < kRgb; ++c) {
    correction.noise[c] = {transfer[c].gain_e_per_count, transfer[c].read_noise_counts};
    calibration.gain_std_e_per_count[c] = transfer[c].gain_std;
    calibration.read_noise_std_counts[c] = transfer[c].read_noise_std;
    worst_transfer = std::max(worst_transfer, transfer[c].worst_sigma);
    transfer_chi2 = std::max(transfer_chi2, transfer[c].reduced_chi2);
  }
  calibration.residuals.push_back(
      {"photon transfer", std::sqrt(transfer_chi2), worst_transfer, 1.3, "standard deviations"});
  calibration.residuals.push_back(
      {"linearity", std::sqrt(fit.reduced_chi2), fit.worst_sigma, 1.3, "standard deviations"});
  calibration.residuals.push_back(
      {"shots of one exposure time", 100.0 * fit.shot_std, 100.0 * fit.shot_std, 0.5, "%"});
  for (std::size_t c = 0; c < kRgb; ++c) {
    std::vector<double> counts, variances;
    for (const TransferPoint& t : flats.transfer) {
      if (t.colour != c) continue;
      counts.push_back(t.pair.counts);
      variances.push_back(t.pair.variance_counts2);
    }
    calibration.noise[c] = capture::radiance_points(counts, variances);
  }

  // The lamp that most is known of gives the vignetting.
  std::vector<double> information(n_of_place.size(), 0.0);
  std::vector<double> counts, departures;
  for (const FlatSample& f : samples) {
    information[f.place] +=
        f.counts * f.counts / (f.variance_dark + f.variance_per_count * f.counts);
    const auto setting = static_cast<Eigen::Index>(shots[f.shot].setting);
    const double expected = fit.log_light_per_s[f.place] + fit.log_true_over_stated[setting] +
                            std::log(flats.settings_s[static_cast<std::size_t>(setting)]);
    counts.push_back(f.counts);
    departures.push_back(std::expm1(std::log(f.counts) - expected));
  }
  calibration.linearity = capture::radiance_points(counts, departures);
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t lamp = 0; lamp < flats.lamps.size(); ++lamp) {
    const auto from = information.begin() + static_cast<std::ptrdiff_t>(lamp * n_blocks);
    const double least = *std::min_element(from, from + static_cast<std::ptrdiff_t>(n_blocks));
    if (least > most) {
      most = least;
      best = lamp;
    }
  }
  // Independent errors of deviation 1 behind the covariance.
  const Eigen::MatrixXd shared = fit.light_rows * covariance_root(fit.joint_covariance);
  steps.light.resize(n_blocks);
  for (std::size_t k = 0; k < n_blocks; ++k) {
    const std::size_t place = best * n_blocks + k;
    if (!(information[place] > 0.0)) continue;
    steps.light[k] = {std::exp(fit.log_light_per_s[place]), 1.0 / information[place],
                      n_of_place[place], shared.row(static_cast<Eigen::Index>(place)).transpose()};
  }
}

}  // namespace scattermeter::calib
