#include "capture/shots/shot_samples.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "capture/sensor/exposure_departure.h"
#include "capture/sensor/frame_samples.h"
#include "capture/sensor/merged_samples.h"
#include "capture/sensor/radiance_calibration.h"
#include "capture/shots/pedestal.h"
#include "core/base/input_error.h"

namespace scattermeter::capture {
namespace {

// Why two frames do not form a bracket, with both values; empty if they do.
std::string bracket_problem(const RawFrame& first, const RawFrame& other) {
  if (other.width_px != first.width_px || other.height_px != first.height_px) {
    return fmt::format("{} x {} samples, that one has {} x {}", other.width_px, other.height_px,
                       first.width_px, first.height_px);
  }
  if (other.make != first.make || other.model != first.model) {
    return fmt::format("shot with a {} {}, that one with a {} {}", other.make, other.model,
                       first.make, first.model);
  }
  if (!(other.cfa == first.cfa)) {
    return fmt::format("filters {}, that one has {}", cfa_pattern_name(other.cfa),
                       cfa_pattern_name(first.cfa));
  }
  if (settings_differ(other.iso, first.iso)) {
    return fmt::format("ISO {:g}, that one has ISO {:g}", other.iso, first.iso);
  }
  if (settings_differ(other.f_number, first.f_number)) {
    return fmt::format("aperture f/{:g}, that one has f/{:g}", other.f_number, first.f_number);
  }
  return "";
}

}  // namespace

ShotSamples shot_samples(const Scene& scene, const ShotDecoding& decoding, const SceneShot& shot,
                         const std::vector<RawFrame>& frames, const std::vector<std::string>& names,
                         int x0, int y0, int width, int height) {
  const std::vector<std::string> files = shot.files();
  if (frames.size() != files.size() || names.size() != files.size()) {
    throw std::invalid_argument("shot_samples: " + std::to_string(files.size()) +
                                " frames and names expected, got " + std::to_string(frames.size()) +
                                " and " + std::to_string(names.size()));
  }
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const std::string problem = bracket_problem(frames[0], frames[k]);
    if (problem.empty()) continue;
    throw InputError(names[k], fmt::format("is listed in one bracket with {} ({}), but {}",
                                           files[0], scene.at(shot.line), problem));
  }
  const auto true_s = [&](const RawFrame& frame) {
    if (!decoding.radiance) return frame.exposure_s;
    const RadianceCorrection& c = decoding.radiance->correction;
    return frame.exposure_s * c.setting(frame.exposure_s).true_over_stated;
  };
  const auto shortest = std::min_element(
      frames.begin(), frames.end(),
      [](const RawFrame& a, const RawFrame& b) { return a.exposure_s < b.exposure_s; });
  std::optional<std::array<double, kRgb>> mean_counts;  // of the shortest
  if (decoding.radiance && frames.size() > 1) {
    mean_counts = frame_mean_counts(*shortest, decoding.radiance->correction);
  }
  ShotSamples out;
  std::vector<CfaSamples> bracket;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    std::optional<std::array<double, kRgb>> mean = mean_counts;
    if (mean) {
      for (double& counts : *mean) counts *= true_s(frames[k]) / true_s(*shortest);
    }
    CorrectedSamples of_frame =
        frame_samples(frames[k], scene.camera.sensor.noise,
                      decoding.radiance ? &decoding.radiance->correction : nullptr, names[k],
                      {x0, y0, width, height}, mean);
    if (k == 0) out.frame_mean_counts = of_frame.frame_mean_counts;
    out.exposures.push_back({files[k],
                             frames[k].exposure_s,
                             of_frame.samples.exposure_s,
                             of_frame.exposure_relative_std,
                             of_frame.black_std_counts,
                             {}});
    if (!decoding.radiance) {
      const Pedestal pedestal = pedestal_of(frames[k], {x0, y0, width, height});
      out.exposures[k].pedestal_counts = pedestal.counts;
      out.exposures[k].pedestal_std_counts = pedestal.std_counts;
      out.exposures[k].beside_counts = pedestal.beside_counts;
    }
    bracket.push_back(std::move(of_frame.samples));
  }
  if (bracket.size() == 1) {
    out.samples = std::move(bracket.front());
    return out;
  }
  out.samples = merged_samples(bracket);
  const std::vector<ExposureDeparture> departures = exposure_departures(bracket, out.samples);
  for (std::size_t k = 0; k < departures.size(); ++k) out.exposures[k].departure = departures[k];
  return out;
}

}  // namespace scattermeter::capture
