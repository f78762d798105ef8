#include "capture/sensor/corrected_samples.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "capture/sensor/saturation.h"

namespace scattermeter::capture {
namespace {

constexpr double kBeyondLastKnot = 1.05;

// Linearised counts and their derivative for every value that a sample of a phase can have.
struct ValueTable {
  std::vector<float> light, gain;
  double clip;
};

std::array<double, 4> black_of(const RawFrame& frame, const RadianceCorrection& correction) {
  std::array<double, 4> black{};
  for (std::size_t p = 0; p < 4; ++p) {
    black[p] = correction.black_counts[p] + correction.dark_counts_per_s[p] * frame.exposure_s;
  }
  return black;
}

std::array<ValueTable, 4> value_tables(const RawFrame& frame,
                                       const RadianceCorrection& correction) {
  const std::array<double, 4> clip = clip_levels(frame);
  const std::array<double, 4> black = black_of(frame, correction);
  std::array<ValueTable, 4> tables;
  for (std::size_t p = 0; p < 4; ++p) {
    const ResponseCurve& curve = correction.response[static_cast<std::size_t>(frame.cfa.phase[p])];
    ValueTable& t = tables[p];
    t.clip = clip[p];
    if (!curve.is_identity()) {
      t.clip = std::min(t.clip, black[p] + kBeyondLastKnot * curve.knot_counts().back());
    }
    const auto n = static_cast<std::size_t>(std::max(clip[p], frame.white_counts)) + 2;
    t.light.resize(std::min<std::size_t>(n, 65536));
    t.gain.resize(t.light.size());
    for (std::size_t v = 0; v < t.light.size(); ++v) {
      const double y = static_cast<double>(v) - black[p];
      t.light[v] = static_cast<float>(curve.light_counts(y));
      t.gain[v] = static_cast<float>(curve.gain_at(y));
    }
  }
  return tables;
}

std::size_t index_in(const ValueTable& table, std::uint16_t value) {
  return std::min<std::size_t>(value, table.light.size() - 1);
}

std::array<double, kRgb> mean_of(const RawFrame& frame, const RadianceCorrection& correction,
                                 const std::array<ValueTable, 4>& tables) {
  const auto width = static_cast<std::size_t>(frame.width_px);
  std::array<double, 4> sum{}, n{};
  std::size_t next = 0;
  for (std::size_t i = 0; i < frame.samples.size(); ++i) {
    if (next < correction.defect_pixels.size() && correction.defect_pixels[next] == i) {
      ++next;
      continue;
    }
    const std::size_t p = cfa_phase(static_cast<int>(i % width), static_cast<int>(i / width));
    sum[p] += static_cast<double>(tables[p].light[index_in(tables[p], frame.samples[i])]);
    n[p] += 1.0;
  }
  std::array<double, kRgb> colour{}, of{};
  for (std::size_t p = 0; p < 4; ++p) {
    const auto c = static_cast<std::size_t>(frame.cfa.phase[p]);
    colour[c] += sum[p];
    of[c] += n[p];
  }
  for (std::size_t c = 0; c < kRgb; ++c) colour[c] /= std::max(1.0, of[c]);
  return colour;
}

void check_rectangle(const RawFrame& frame, int x0, int y0, int width, int height) {
  if (x0 < 0 || y0 < 0 || width < 0 || height < 0 || x0 + width > frame.width_px ||
      y0 + height > frame.height_px) {
    throw std::invalid_argument("corrected_samples: the rectangle is not inside the frame");
  }
}

// The frame as the noise models need it: the black level without dark current, as dark current has
// the shot noise of photoelectrons.
RawFrame noise_frame(const RawFrame& frame, const RadianceCorrection& correction) {
  RawFrame out;
  out.curve_levels = frame.curve_levels;
  out.black_counts = correction.black_counts;
  return out;
}

// The smallest signal that noise cut at zero does not bias, counts: four deviations of the read
// noise above zero.
double floor_of(const RawFrame& frame, const RadianceCorrection& correction) {
  double floor_counts = 0.0;
  for (std::size_t p = 0; p < 4; ++p) {
    const auto c = static_cast<std::size_t>(frame.cfa.phase[p]);
    const double above_zero = correction.black_counts[p];
    const double wanted = 4.0 * correction.noise[c].read_noise_counts;
    if (above_zero < wanted) floor_counts = std::max(floor_counts, wanted - above_zero);
  }
  return floor_counts;
}

// Signal, variance and clipping of every sample of the rectangle that `s` names.
void correct_samples(const RawFrame& frame, const RadianceCorrection& correction,
                     const std::array<ValueTable, 4>& tables,
                     const std::array<double, kRgb>& frame_mean, CfaSamples& s) {
  std::vector<NoiseModel> noise;
  const RawFrame levels = noise_frame(frame, correction);
  for (const SensorNoise& of_colour : correction.noise) noise.emplace_back(of_colour, levels);
  std::array<double, kRgb> glare_counts{};
  for (std::size_t c = 0; c < kRgb; ++c) {
    glare_counts[c] = correction.glare_share[c] * frame_mean[c];
  }
  const std::size_t n = static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height);
  s.signal_counts.resize(n);
  s.variance_counts2.resize(n);
  s.variance_per_count_of.resize(n);
  s.clipped.assign(n, 0);
  const bool even = correction.vignetting.is_identity();
  double per_count = 0.0;
  std::size_t i = 0;
  for (int y = s.y0; y < s.y0 + s.height; ++y) {
    for (int x = s.x0; x < s.x0 + s.width; ++x, ++i) {
      const std::size_t p = cfa_phase(x, y);
      const auto c = static_cast<std::size_t>(s.channel_of_phase[p]);
      const std::uint16_t v = frame.at(x, y);
      const std::size_t at = index_in(tables[p], v);
      const double share = even ? 1.0 : correction.vignetting.share(x, y, c);
      const double factor = static_cast<double>(tables[p].gain[at]) / share;
      s.signal_counts[i] =
          static_cast<float>((static_cast<double>(tables[p].light[at]) - glare_counts[c]) / share);
      s.variance_counts2[i] =
          static_cast<float>(factor * factor * noise[c].variance_counts2(v, static_cast<int>(p)));
      if (static_cast<double>(v) >= tables[p].clip) s.clipped[i] = kSampleClipped;
      s.variance_per_count_of[i] =
          static_cast<float>(factor / correction.noise[c].gain_e_per_count);
      per_count += factor / correction.noise[c].gain_e_per_count;
    }
  }
  // The black error of counts after the division by vignetting, as the mean over the rectangle and
  // its colours.
  if (n > 0) s.variance_per_count = per_count / static_cast<double>(n);
}

void mark_defects(const std::vector<std::size_t>& defect_pixels, int frame_width_px,
                  CfaSamples& s) {
  for (const std::size_t pixel : defect_pixels) {
    const auto x = static_cast<int>(pixel % static_cast<std::size_t>(frame_width_px)) - s.x0;
    const auto y = static_cast<int>(pixel / static_cast<std::size_t>(frame_width_px)) - s.y0;
    if (x < 0 || y < 0 || x >= s.width || y >= s.height) continue;
    s.clipped[static_cast<std::size_t>(y) * static_cast<std::size_t>(s.width) +
              static_cast<std::size_t>(x)] = kSampleDefect;
  }
}

}  // namespace

std::string correction_problem(const RawFrame& frame, const RadianceCorrection& correction) {
  const auto text = [](double v) {
    std::string s = std::to_string(v);
    s.erase(s.find_last_not_of('0') + 1);
    if (s.back() == '.') s.pop_back();
    return s;
  };
  if (frame.width_px != correction.width_px || frame.height_px != correction.height_px) {
    return std::to_string(frame.width_px) + " x " + std::to_string(frame.height_px) +
           " samples, but the radiance calibration is for " + std::to_string(correction.width_px) +
           " x " + std::to_string(correction.height_px);
  }
  if (settings_differ(frame.iso, correction.iso)) {
    return "ISO " + text(frame.iso) + ", but the radiance calibration is for ISO " +
           text(correction.iso);
  }
  if (settings_differ(frame.f_number, correction.f_number)) {
    return "aperture f/" + text(frame.f_number) + ", but the radiance calibration is for f/" +
           text(correction.f_number);
  }
  return "";
}

std::array<double, kRgb> frame_mean_counts(const RawFrame& frame,
                                           const RadianceCorrection& correction) {
  return mean_of(frame, correction, value_tables(frame, correction));
}

CorrectedSamples corrected_samples(
    const RawFrame& frame, const RadianceCorrection& correction, int x0, int y0, int width,
    int height, const std::optional<std::array<double, kRgb>>& frame_mean_counts) {
  check_rectangle(frame, x0, y0, width, height);
  if (!(frame.exposure_s > 0.0)) {
    throw std::invalid_argument("corrected_samples: exposure_s is not positive");
  }
  if (const std::string problem = correction_problem(frame, correction); !problem.empty()) {
    throw std::invalid_argument("corrected_samples: " + problem);
  }
  const std::array<ValueTable, 4> tables = value_tables(frame, correction);
  CorrectedSamples out;
  out.black_std_counts = correction.black_std_counts;
  out.frame_mean_counts =
      frame_mean_counts ? *frame_mean_counts : mean_of(frame, correction, tables);
  const ShutterSetting shutter = correction.setting(frame.exposure_s);
  out.exposure_relative_std = shutter.relative_std;
  CfaSamples& s = out.samples;
  s.x0 = x0;
  s.y0 = y0;
  s.width = width;
  s.height = height;
  s.exposure_s = frame.exposure_s * shutter.true_over_stated;
  for (std::size_t p = 0; p < 4; ++p) s.channel_of_phase[p] = static_cast<int>(frame.cfa.phase[p]);
  s.floor_counts = std::max(s.floor_counts, floor_of(frame, correction));
  correct_samples(frame, correction, tables, out.frame_mean_counts, s);
  mark_defects(correction.defect_pixels, frame.width_px, s);
  return out;
}

}  // namespace scattermeter::capture
