#include "apps/planning/exposure_advice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "apps/simulation/chosen_exposure.h"
#include "core/camera/sensor_noise.h"

namespace scattermeter::apps {
namespace {

constexpr double kTooBright = 0.95;  // of the range
constexpr double kTooDark = 0.2;     // of the range: a longer time would collect more light
constexpr double kMuchClipped = 1e-3;
// A bracket is suggested if a tenth of the samples is below this many standard deviations of the
// read noise.
constexpr double kDarkTenth = 10.0;
constexpr double kBracketStep = 4.0;
constexpr std::size_t kMostFiles = 4;

double counts_quantile(std::vector<float> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return static_cast<double>(values[static_cast<std::size_t>(at)]);
}

// Expected counts of the samples in rows, by channel, in the first file.
std::array<std::vector<float>, kRgb> row_counts(const Rig& rig, const LinearPicture& picture,
                                                const SampleMap& map) {
  std::array<std::vector<float>, kRgb> out;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                      static_cast<std::size_t>(x);
      const int px = map.x0 + x - picture.x0;
      const int py = map.y0 + y - picture.y0;
      if (map.row_of_sample[at] < 0 || px < 0 || py < 0 || px >= picture.width ||
          py >= picture.height) {
        continue;
      }
      const auto c =
          static_cast<std::size_t>(rig.scene.camera.sensor.cfa.at(map.x0 + x, map.y0 + y));
      out[c].push_back(
          picture.counts[static_cast<std::size_t>(py) * static_cast<std::size_t>(picture.width) +
                         static_cast<std::size_t>(px)]);
    }
  }
  return out;
}

double share_of(const std::vector<float>& values, const auto& holds) {
  if (values.empty()) return 0.0;
  return static_cast<double>(std::count_if(values.begin(), values.end(), holds)) /
         static_cast<double>(values.size());
}

// A time for the brightest channel, and longer ones until no channel has a dark tenth of its
// samples.
std::vector<double> suggested(const std::array<ExposureAdvice, kRgb>& channels,
                              const std::array<SensorNoise, kRgb>& noise) {
  double fullest = 0.0;
  double longer = 1.0;
  for (const ExposureAdvice& a : channels) {
    fullest = std::max(fullest, a.brightest_counts / a.range_counts);
  }
  if (!(fullest > 0.0)) return {};
  const double factor = kExposedTo / fullest;
  for (std::size_t c = 0; c < kRgb; ++c) {
    const double dark = factor * channels[c].dark_counts;
    const double wanted = kDarkTenth * std::max(noise[c].read_noise_counts, 0.3);
    if (dark > 0.0) longer = std::max(longer, wanted / dark);
  }
  std::vector<double> out = {rounded_exposure_s(factor * channels[0].exposure_s.front())};
  while (longer > 1.0 && out.size() < kMostFiles) {
    out.push_back(rounded_exposure_s(kBracketStep * out.back()));
    longer /= kBracketStep;
  }
  return out;
}

std::string times_text(const std::vector<double>& list) {
  std::string out;
  for (const double s : list) out += fmt::format("{}{:.3g}", out.empty() ? "" : ", ", s);
  return out + " s";
}

std::string advice_of(const ExposureAdvice& a) {
  if (a.suggested_s.empty()) return "no light of the shot reaches a row of the object";
  const std::string instead =
      (a.suggested_s.size() > 1 ? "a bracket of " : "") + times_text(a.suggested_s) + " would do";
  if (a.clipped_share > kMuchClipped) {
    return fmt::format("{:.3g} % of the object is clipped; {}", 100.0 * a.clipped_share, instead);
  }
  const double shortest =
      *std::min_element(a.exposure_s.begin(), a.exposure_s.end()) / a.exposure_s.front();
  const double longest =
      *std::max_element(a.exposure_s.begin(), a.exposure_s.end()) / a.exposure_s.front();
  if (shortest * a.brightest_counts > kTooBright * a.range_counts) {
    return fmt::format("the brightest place is {:.0f} % of the range, noise will clip it; {}",
                       100.0 * shortest * a.brightest_counts / a.range_counts, instead);
  }
  if (longest * a.brightest_counts < kTooDark * a.range_counts) {
    return fmt::format("the brightest place is {:.2g} % of the range; {}",
                       100.0 * longest * a.brightest_counts / a.range_counts, instead);
  }
  if (a.dark_share > 0.1 && a.exposure_s.size() == 1 && a.suggested_s.size() > 1) {
    return fmt::format("{:.0f} % of the object lies in the noise; {}", 100.0 * a.dark_share,
                       instead);
  }
  return "";
}

}  // namespace

std::vector<ExposureAdvice> exposure_advice(const Rig& rig, const VirtualShots& shots,
                                            const std::vector<ObservedShot>& opened,
                                            const std::array<SensorNoise, kRgb>& noise,
                                            double range_counts) {
  std::vector<ExposureAdvice> out;
  for (std::size_t i = 0; i < opened.size(); ++i) {
    const SceneShot& shot = *opened[i].stated;
    const std::array<std::vector<float>, kRgb> counts =
        row_counts(rig, shots.picture(i), opened[i].seen->map);
    std::array<ExposureAdvice, kRgb> channels;
    for (std::size_t c = 0; c < kRgb; ++c) {
      ExposureAdvice& a = channels[c];
      a.shot = shot.file;
      a.material = shot.material;
      a.channel = kRgbName[c];
      for (std::size_t k = 0; k < shot.files().size(); ++k) {
        a.exposure_s.push_back(shots.exposure_s(i, k));
      }
      a.chosen = !shot.exposure_s && !rig.scene.camera.exposure_s;
      a.range_counts = range_counts;
      const auto [shortest, longest] =
          std::minmax_element(a.exposure_s.begin(), a.exposure_s.end());
      const double least = *shortest / a.exposure_s.front();
      const double most = *longest / a.exposure_s.front();
      a.brightest_counts = counts_quantile(counts[c], 1.0);
      a.dark_counts = counts_quantile(counts[c], 0.1);
      a.clipped_share = share_of(
          counts[c], [&](float v) { return least * static_cast<double>(v) >= range_counts; });
      a.dark_share = share_of(counts[c], [&](float v) {
        const double expected = most * static_cast<double>(v);
        const double variance = expected / noise[c].gain_e_per_count +
                                noise[c].read_noise_counts * noise[c].read_noise_counts;
        return expected < 3.0 * std::sqrt(variance);
      });
    }
    // Without a responsivity, the brightness of the picture is an arbitrary choice.
    const std::vector<double> times_s =
        rig.scene.camera.responsivity ? suggested(channels, noise) : std::vector<double>{};
    for (ExposureAdvice& a : channels) {
      a.suggested_s = times_s;
      if (rig.scene.camera.responsivity) a.advice = advice_of(a);
      out.push_back(a);
    }
  }
  return out;
}

}  // namespace scattermeter::apps
