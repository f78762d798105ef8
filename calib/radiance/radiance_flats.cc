// Photon transfer, linearity and exposure times from the flats.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/core.h>

#include "calib/radiance/flat_frames.h"
#include "calib/radiance/photon_transfer.h"
#include "calib/radiance/radiance_steps.h"
#include "core/base/covariance_root.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {
namespace {

constexpr double kMostOfRange = 0.95;  // of a block mean: its noise must not reach the clip level
constexpr double kTransferTop = 0.8;   // of the range, for the photon transfer

using Transfer = std::array<PhotonTransfer, kRgb>;

// Photon transfer of each colour with counts linearised by the curve.
Transfer transfer_of(const RadianceSteps& steps, const FlatFrames& flats,
                     const ResponseCurve& curve) {
  std::array<std::vector<NoisePoint>, kRgb> points;
  for (const TransferPoint& t : flats.transfer) {
    if (t.pair.counts > kTransferTop * flats.range_counts) continue;
    const double g = curve.gain_at(t.pair.counts);
    points[t.colour].push_back({curve.light_counts(t.pair.counts), g * g * t.pair.variance_counts2,
                                g * g * t.quantisation_counts2, static_cast<double>(t.pair.n - 1)});
  }
  Transfer out;
  for (std::size_t c = 0; c < kRgb; ++c) {
    out[c] = fit_photon_transfer(points[c]);
    if (!out[c].ok) {
      throw InputError(
          steps.input.shots.at(steps.input.shots.line) + ": calibration.radiance.flats",
          fmt::format("channel {}: the noise of {} blocks does not grow with the light; is "
                      "each pair two separate exposures, and are the files raws?",
                      kRgbName[c], points[c].size()));
    }
  }
  return out;
}

// The flats in the form that fit_response() takes. A place is a block under one lamp, with index
// lamp n_blocks + block.
struct ResponseInput {
  std::vector<FlatSample> samples;
  std::vector<FlatShot> shots;
  std::vector<double> n_of_place;  // number of samples of each; 0 if no flat is usable
};

ResponseInput response_input(const RadianceSteps& steps, const FlatFrames& flats,
                             const Transfer& noise) {
  ResponseInput in;
  const std::size_t n_blocks = steps.blocks.size();
  in.n_of_place.assign(n_blocks * flats.lamps.size(), 0.0);
  for (const FlatBlocks& flat : flats.shots) {
    for (std::size_t k = 0; k < n_blocks; ++k) {
      const BlockMean& m = flat.means[k];
      if (m.n == 0 || m.counts < kLeastFlatCounts || m.counts > kMostOfRange * flats.range_counts) {
        continue;
      }
      const auto phase = static_cast<std::size_t>(steps.blocks[k].phase);
      const PhotonTransfer& t = noise[static_cast<std::size_t>(steps.cfa.phase[phase])];
      const double dark = std::max(t.read_noise_counts * t.read_noise_counts, 0.01) + 1. / 12;
      in.samples.push_back({in.shots.size(), flat.lamp * n_blocks + k, m.counts, dark / m.n,
                            1.0 / (t.gain_e_per_count * m.n)});
      in.n_of_place[in.samples.back().place] = m.n;
    }
    in.shots.push_back({flat.setting});
  }
  return in;
}

// Stores curve and exposure times for the correction and for the following steps.
void keep_response(const ResponseFit& fit, const std::vector<double>& settings_s,
                   RadianceSteps& steps) {
  capture::RadianceCalibration& calibration = steps.calibration;
  capture::RadianceCorrection& correction = calibration.correction;
  steps.settings_s = settings_s;
  steps.response_covariance = fit.joint_covariance;
  steps.shot_std = fit.shot_std;
  // All colours have the same converter and therefore the same curve.
  for (std::size_t c = 0; c < kRgb; ++c) {
    correction.response[c] = fit.curve;
    const Eigen::MatrixXd& v = fit.curve_covariance;
    calibration.response_covariance[c].assign(v.data(), v.data() + v.size());
  }
  double squares = 0;
  for (std::size_t s = 0; s < settings_s.size(); ++s) {
    const auto i = static_cast<Eigen::Index>(s);
    const double log_ratio = fit.log_true_over_stated[i];
    squares += log_ratio * log_ratio;
    correction.shutter.push_back(
        {settings_s[s], std::exp(log_ratio),
         std::hypot(std::sqrt(fit.setting_covariance(i, i)), fit.shot_std)});
  }
  std::sort(correction.shutter.begin(), correction.shutter.end(),
            [](const auto& a, const auto& b) { return a.stated_s < b.stated_s; });
  correction.shutter_relative_std =
      std::hypot(std::sqrt(squares / static_cast<double>(settings_s.size() - 1)), fit.shot_std);
}

// Stores gain and read noise with the points to which they were fitted.
void keep_noise(const FlatFrames& flats, const Transfer& transfer,
                capture::RadianceCalibration& calibration) {
  double worst = 0, chi2 = 0;
  for (std::size_t c = 0; c < kRgb; ++c) {
    calibration.correction.noise[c] = {transfer[c].gain_e_per_count, transfer[c].read_noise_counts};
    calibration.gain_std_e_per_count[c] = transfer[c].gain_std;
    calibration.read_noise_std_counts[c] = transfer[c].read_noise_std;
    worst = std::max(worst, transfer[c].worst_sigma);
    chi2 = std::max(chi2, transfer[c].reduced_chi2);
    std::vector<double> counts, variances;
    for (const TransferPoint& t : flats.transfer) {
      if (t.colour != c) continue;
      counts.push_back(t.pair.counts);
      variances.push_back(t.pair.variance_counts2);
    }
    calibration.noise[c] = capture::radiance_points(counts, variances);
  }
  calibration.residuals.push_back(
      {"photon transfer", std::sqrt(chi2), worst, 1.3, "standard deviations"});
}

// Stores the departures of the samples from linearity after the fit.
void keep_departures(const ResponseInput& in, const ResponseFit& fit,
                     const std::vector<double>& settings_s,
                     capture::RadianceCalibration& calibration) {
  std::vector<double> counts, departures;
  for (const FlatSample& f : in.samples) {
    const auto setting = static_cast<Eigen::Index>(in.shots[f.shot].setting);
    const double expected = fit.log_light_per_s[f.place] + fit.log_true_over_stated[setting] +
                            std::log(settings_s[static_cast<std::size_t>(setting)]);
    counts.push_back(f.counts);
    departures.push_back(std::expm1(std::log(f.counts) - expected));
  }
  calibration.linearity = capture::radiance_points(counts, departures);
  calibration.residuals.push_back(
      {"linearity", std::sqrt(fit.reduced_chi2), fit.worst_sigma, 1.3, "standard deviations"});
  calibration.residuals.push_back(
      {"shots of one exposure time", 100.0 * fit.shot_std, 100.0 * fit.shot_std, 0.5, "%"});
}

// The light of each block under the lamp with the smallest uncertainty of its worst block; that
// lamp is used for the vignetting.
void keep_light(const ResponseInput& in, const ResponseFit& fit, std::size_t n_lamps,
                RadianceSteps& steps) {
  std::vector<double> information(in.n_of_place.size(), 0.0);
  for (const FlatSample& f : in.samples) {
    information[f.place] +=
        f.counts * f.counts / (f.variance_dark + f.variance_per_count * f.counts);
  }
  const std::size_t n_blocks = steps.blocks.size();
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t lamp = 0; lamp < n_lamps; ++lamp) {
    const auto from = information.begin() + static_cast<std::ptrdiff_t>(lamp * n_blocks);
    const double least = *std::min_element(from, from + static_cast<std::ptrdiff_t>(n_blocks));
    if (least > most) {
      most = least;
      best = lamp;
    }
  }
  // Independent errors of unit standard deviation that give the covariance.
  const Eigen::MatrixXd shared = fit.light_rows * covariance_root(fit.joint_covariance);
  steps.light.resize(n_blocks);
  for (std::size_t k = 0; k < n_blocks; ++k) {
    const std::size_t place = best * n_blocks + k;
    if (!(information[place] > 0.0)) continue;
    steps.light[k] = {std::exp(fit.log_light_per_s[place]), 1.0 / information[place],
                      in.n_of_place[place],
                      shared.row(static_cast<Eigen::Index>(place)).transpose()};
  }
}

}  // namespace

void find_response_and_noise(RadianceSteps& steps) {
  capture::RadianceCalibration& calibration = steps.calibration;
  const FlatFrames flats = open_flats(steps);
  if (!flats.dark_pairs) {
    calibration.notes.emplace_back(
        "no two dark frames of equal exposure time: the read noise rests on the flats alone");
  }
  const ResponseInput in = response_input(steps, flats, transfer_of(steps, flats, {}));
  ResponseFitOptions options;
  options.black_std_counts = calibration.correction.black_std_counts;
  const ResponseFit fit =
      fit_response(in.samples, in.shots, flats.settings_s, in.n_of_place.size(), options);
  if (!fit.ok) {
    throw InputError(
        steps.input.shots.at(steps.input.shots.line) + ": calibration.radiance.flats",
        "linearity: too few blocks are neither clipped nor dark in three exposure times; step the "
        "times more finely");
  }
  keep_response(fit, flats.settings_s, steps);
  keep_noise(flats, transfer_of(steps, flats, fit.curve), calibration);
  keep_departures(in, fit, flats.settings_s, calibration);
  keep_light(in, fit, flats.lamps.size(), steps);
}

}  // namespace scattermeter::calib
