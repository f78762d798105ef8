#include "apps/planning/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include <fmt/core.h>

#include "apps/instrument/instrument.h"
#include "apps/instrument/rig_inputs.h"
#include "apps/planning/shot_forecaster.h"
#include "apps/rig/open_objects.h"
#include "apps/simulation/simulate.h"
#include "calib/pose/shot_pose.h"
#include "capture/sensor/radiance_calibration.h"
#include "core/base/input_error.h"
#include "core/base/progress.h"
#include "core/camera/channel_index.h"
#include "core/camera/sensor_noise.h"
#include "core/estimation/estimation.h"

namespace scattermeter::apps {
namespace {

// Patches across an object in the forecast of shots that the rig does not list.
constexpr double kCoarsePatches = 16.0;

std::array<SensorNoise, kRgb> noise_of(const Rig& rig) {
  if (rig.decoding.radiance) return rig.decoding.radiance->correction.noise;
  std::array<SensorNoise, kRgb> out;
  out.fill(rig.scene.camera.sensor.noise);
  return out;
}

// The opened shots of the expected materials.
struct ExpectedShots {
  std::vector<ObservedShot> shots;
  std::array<double, kRgb> responsivity{};
};

// Adds what measuring reported for these materials: the expected ones (is_first), then corners.
void add_forecasts(const Measurement& m, const TruthMaterials& materials, bool is_first,
                   std::vector<PlannedChannel>& channels) {
  if (is_first) channels.resize(m.results.size());
  for (std::size_t r = 0; r < m.results.size(); ++r) {
    const ChannelResult& result = m.results[r];
    Medium medium = materials.at(result.material)[channel_index(result.channel)];
    medium.eta_int_over_ext = result.eta_int_over_ext;
    if (is_first) {
      channels[r] = {{medium, result.estimate}, result, {}};
    } else {
      channels[r].corners.push_back({medium, result.estimate});
    }
  }
}

// For every material its channel with the largest relative uncertainty of sigma_a.
std::vector<SuggestionRequest> suggestion_requests(const Rig& rig, const TruthMaterials& expected,
                                                   const std::vector<PlannedChannel>& channels) {
  std::vector<SuggestionRequest> out;
  for (const std::string& material : rig.scene.materials()) {
    const PlannedChannel* worst = nullptr;
    const auto relative = [](const PlannedChannel& c) {
      const Quantity& a = c.result.estimate.sigma_a_per_mm;
      return c.result.estimate.converged && a.value > 0.0 ? a.std / a.value : -1.0;
    };
    for (const PlannedChannel& c : channels) {
      if (c.result.material != material || !(relative(c) > 0.0)) continue;
      if (worst == nullptr || relative(c) > relative(*worst)) worst = &c;
    }
    if (worst == nullptr) continue;
    const std::size_t channel = channel_index(worst->result.channel);
    out.push_back({{material, channel, expected.at(material), worst->result.eta_int_over_ext},
                   worst->result.estimate.sigma_a_per_mm});
  }
  return out;
}

std::vector<SuggestedShots> suggestions(const Rig& rig, const ObjectScenes& objects,
                                        const TruthMaterials& materials,
                                        const ExpectedShots& expected, double range_counts,
                                        const Plan& plan, Progress* progress) {
  double coarse_mm = 0.0;
  double measured_mm = 0.0;
  for (const auto& [name, object] : objects) {
    measured_mm = std::max(measured_mm, plan.patch_size_mm.at(name));
    coarse_mm = std::max({coarse_mm, object.size_mm() / kCoarsePatches, measured_mm});
  }
  ShotForecaster forecaster(rig, objects, expected.shots, coarse_mm, measured_mm,
                            expected.responsivity, plan.noise, range_counts);
  return suggested_shots(rig, suggestion_requests(rig, materials, plan.channels),
                         scale_prior(rig.scene), forecaster, progress);
}

}  // namespace

bool Plan::any_refused() const {
  return std::any_of(channels.begin(), channels.end(), [](const PlannedChannel& c) {
    return c.result.refused() ||
           std::any_of(c.corners.begin(), c.corners.end(),
                       [](const Forecast& f) { return !f.estimate.reasons.empty(); });
  });
}

RelativeRange relative_range(const PlannedChannel& channel, Quantity Estimate::*coefficient) {
  RelativeRange out{std::numeric_limits<double>::quiet_NaN(),
                    std::numeric_limits<double>::quiet_NaN()};
  const auto add = [&](const Forecast& f) {
    const Quantity& q = f.estimate.*coefficient;
    const double relative = q.std / q.value;
    if (!f.estimate.converged || !std::isfinite(relative)) return;
    out.low = std::isnan(out.low) ? relative : std::min(out.low, relative);
    out.high = std::isnan(out.high) ? relative : std::max(out.high, relative);
  };
  add(channel.expected);
  for (const Forecast& corner : channel.corners) add(corner);
  return out;
}

std::string percent_text(double relative) {
  if (!std::isfinite(relative)) return "–";
  // From ten on without decimals: "100 %", not "1e+02 %".
  const double percent = 100.0 * relative;
  return percent < 9.95 ? fmt::format("{:.2g} %", percent) : fmt::format("{:.0f} %", percent);
}

std::string percent_text(const RelativeRange& r) {
  const std::string high = percent_text(r.high);
  if (percent_text(r.low) == high) return high;
  const std::string low = percent_text(r.low);
  return low.substr(0, low.size() - 2) + " … " + high;
}

std::vector<KnownCause> known_causes(const Estimate& estimate) {
  const auto without = [](double all, double line) {
    return std::sqrt(std::max(0.0, all * all - line * line));
  };
  std::vector<KnownCause> out;
  for (const BudgetLine& line : estimate.budget) {
    if (line.cause == "noise" || line.cause == "numerics") continue;
    out.push_back({line.cause,
                   without(estimate.sigma_s_prime_per_mm.std, line.std_sigma_s_prime_per_mm),
                   without(estimate.sigma_a_per_mm.std, line.std_sigma_a_per_mm)});
  }
  std::stable_sort(out.begin(), out.end(), [](const KnownCause& x, const KnownCause& y) {
    return x.sigma_a_std_per_mm < y.sigma_a_std_per_mm;
  });
  return out;
}

Rig planned_rig(const Rig& given) {
  Rig rig = given;
  if (!rig.decoding.radiance || !(rig.truth.sensor == capture::SensorTruth{})) return rig;
  auto calibration = std::make_shared<capture::RadianceCalibration>(*rig.decoding.radiance);
  capture::RadianceCorrection& c = calibration->correction;
  c.iso = rig.scene.camera.iso;
  c.f_number = rig.scene.camera.f_number;
  for (std::size_t p = 0; p < 4; ++p) c.black_counts[p] = rig.scene.camera.sensor.black_counts[p];
  c.dark_counts_per_s = {};
  c.defect_pixels.clear();
  c.response = {};
  c.vignetting = vignetting_of_frame(c.width_px, c.height_px);
  c.glare_share = {};
  for (capture::ShutterSetting& s : c.shutter) s.true_over_stated = 1.0;
  rig.decoding.radiance = calibration;
  return rig;
}

Plan plan(const Rig& given, const ObjectScenes& objects, const PlanOptions& options) {
  for (const SceneObject& object : given.scene.objects) {
    if (!(object.surface_alpha > 0.0)) continue;
    throw InputError(given.at(object.line) + ": objects." + object.name + ".roughness",
                     "plan forecasts shots of smooth objects only");
  }
  Plan out;
  Stopwatch watch(out.timing_s);
  const std::vector<TruthMaterials> materials =
      expected_materials(given, options.sigma_s_prime_per_mm, options.sigma_a_per_mm);
  out.from_truth = !options.sigma_s_prime_per_mm && !options.sigma_a_per_mm;
  if (options.rendered != nullptr && !out.from_truth) {
    throw std::invalid_argument("plan: rendered shots are those of the rig's truth");
  }
  Rig rig = planned_rig(given);
  out.neutral_camera =
      rig.decoding.radiance != nullptr && rig.decoding.radiance != given.decoding.radiance;
  if (rig.pose.charuco && !rig.pose.board_shot.empty()) {
    calib::take_points_from_board_shot(board_frame(rig), rig.pose.board_shot, rig.pose);
  }
  out.calibrated_noise = rig.decoding.radiance != nullptr;
  out.noise = noise_of(rig);
  out.brightness_known = rig.scene.camera.responsivity.has_value();
  MeasureOptions measure_options;
  measure_options.patch_size_mm = options.patch_size_mm;
  Instrument instrument(rig, objects, measure_options, options.progress);
  watch.lap("geometry");
  ExpectedShots expected;
  const double range_counts =
      capture::VirtualSensor(rig.scene, rig.truth.sensor, false).range_counts();
  for (std::size_t k = 0; k < materials.size(); ++k) {
    Rig truth = rig;
    truth.truth.materials = materials[k];
    std::optional<VirtualShots> own;
    if (options.rendered == nullptr) {
      own.emplace(truth, objects, VirtualShotOptions{.noise = false, .progress = options.progress});
    }
    const VirtualShots& shots = own ? *own : *options.rendered;
    watch.lap("rendering");
    ExpectedShots at_corner;
    ExpectedShots& opened = k == 0 ? expected : at_corner;
    opened.responsivity = shots.responsivity();
    const Measurement m = instrument.forecast(shots.expected_source(), opened.shots);
    out.patch_size_mm = m.patch_size_mm;
    add_forecasts(m, materials[k], k == 0, out.channels);
    if (k == 0) {
      out.places = m.places;
      out.exposures = exposure_advice(rig, shots, opened.shots, out.noise, range_counts);
    }
    watch.lap("forecast");
  }
  if (options.suggested_shots) {
    out.suggested_shots =
        suggestions(rig, objects, materials.front(), expected, range_counts, out, options.progress);
    watch.lap("other shots");
  }
  watch.total();
  return out;
}

Plan plan(const Rig& rig, const PlanOptions& options, Progress* progress) {
  const ObjectScenes objects = open_objects(rig);
  PlanOptions own = options;
  own.progress = progress;
  Plan out = plan(rig, objects, own);
  capture::FileDigests digests;
  out.inputs = rig_inputs(rig, objects, digests);
  return out;
}

}  // namespace scattermeter::apps
