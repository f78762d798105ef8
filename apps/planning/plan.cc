#include "apps/planning/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include <fmt/core.h>

#include "apps/instrument/instrument.h"
#include "apps/instrument/open_objects.h"
#include "apps/instrument/rig_inputs.h"
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

// Patches across an object, for shots that are only thought of.
constexpr double kCoarsePatches = 16.0;

using TruthMaterials = std::map<std::string, std::array<Medium, 3>>;

void require_range(const char* name, const std::optional<ExpectedRange>& range) {
  if (!range || (range->low >= 0.0 && range->low <= range->high && std::isfinite(range->high))) {
    return;
  }
  throw std::invalid_argument(
      fmt::format("plan: {} from {} to {} is no range", name, range->low, range->high));
}

// Every material's media: the middle of the ranges first, then their corners.
std::vector<TruthMaterials> expected_materials(const Rig& rig, const PlanOptions& options) {
  const auto& s = options.sigma_s_prime_per_mm;
  const auto& a = options.sigma_a_per_mm;
  const auto filled = [&](double s_place, double a_place) {
    TruthMaterials out;
    for (const std::string& material : rig.scene.materials()) {
      std::array<Medium, 3>& media = out[material];
      const auto truth = rig.truth.materials.find(material);
      if (truth != rig.truth.materials.end()) {
        media = truth->second;
      } else if (!s || !a) {
        throw InputError(
            rig.path + ": truth.materials." + material,
            "is missing: without it, state what to expect (--sigma-s-prime, --sigma-a)");
      }
      for (Medium& m : media) {
        // sigma_s' spans magnitudes, sigma_a may begin at 0.
        if (s) m.sigma_s_prime_per_mm = s->low * std::pow(s->high / s->low, s_place);
        if (a) m.sigma_a_per_mm = a->low + a_place * (a->high - a->low);
      }
    }
    return out;
  };
  std::vector<TruthMaterials> out = {filled(0.5, 0.5)};
  for (const double s_place : {0.0, 1.0}) {
    if (s_place > 0.0 && (!s || s->low == s->high)) continue;
    for (const double a_place : {0.0, 1.0}) {
      if (a_place > 0.0 && (!a || a->low == a->high)) continue;
      out.push_back(filled(s_place, a_place));
    }
  }
  // One corner alone is the middle.
  if (out.size() == 2) out.pop_back();
  return out;
}

std::array<SensorNoise, kRgb> noise_of(const Rig& rig) {
  if (rig.decoding.radiance) return rig.decoding.radiance->correction.noise;
  std::array<SensorNoise, kRgb> out;
  out.fill(rig.scene.camera.sensor.noise);
  return out;
}

// The tasks of other_shots(): of every material its channel of least known sigma_a.
std::vector<OtherShotsTask> other_tasks(const Rig& rig, const TruthMaterials& expected,
                                        const std::vector<PlannedChannel>& channels) {
  std::vector<OtherShotsTask> out;
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
  // Whole per cent from ten on: "100 %", not "1e+02 %".
  const double percent = 100.0 * relative;
  return percent < 9.95 ? fmt::format("{:.2g} %", percent) : fmt::format("{:.0f} %", percent);
}

std::string percent_text(const RelativeRange& r) {
  const std::string high = percent_text(r.high);
  if (percent_text(r.low) == high) return high;
  const std::string low = percent_text(r.low);
  return low.substr(0, low.size() - 2) + " … " + high;
}

std::vector<std::string> plan_assumptions(const Plan& plan) {
  std::vector<std::string> out;
  out.push_back(plan.from_truth
                    ? "The materials are the rig's truth.materials."
                    : "The materials are the middle and the corners of the range that was given.");
  out.push_back(
      fmt::format("The noise is that of {}: {:.3g} electrons a count and {:.3g} counts read noise "
                  "(green).",
                  plan.calibrated_noise ? "camera.radiance" : "camera.sensor",
                  plan.noise[1].gain_e_per_count, plan.noise[1].read_noise_counts));
  out.emplace_back(
      "The dipole makes the expected shots and the dipole is fitted to them, as measure --model "
      "dipole does. Where measure has to answer by transport, the Monte Carlo error of its paths "
      "comes on top, and what the shape adds to the information is not in the forecast.");
  out.emplace_back(
      "Everything stands where the rig says; standard deviations of LEDs, pose, lens, scale and "
      "eta "
      "are those that the rig and its calibrations state.");
  if (!plan.brightness_known) {
    out.emplace_back(
        "The rig has no responsivity: how bright a shot will be is not known, and the brightest "
        "place counts as three quarters of the range.");
  }
  if (plan.neutral_camera) {
    out.emplace_back(
        "The rig has no truth.sensor: the camera counts as one that needs no correction, known as "
        "well as camera.radiance states.");
  }
  if (!plan.other_shots.empty()) {
    out.emplace_back(
        "Maps and gains of other shots are linearised on coarse patches and told relative to the "
        "shots as planned. The added shot is exposed so that nothing clips; its LED is as bright "
        "and as well known as the one it is like, and hides nothing from the camera; a card's edge "
        "counts as exactly placed.");
  }
  return out;
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

Plan plan(const Rig& given, const ObjectScenes& scenes, const PlanOptions& options) {
  require_range("sigma_s'", options.sigma_s_prime_per_mm);
  require_range("sigma_a", options.sigma_a_per_mm);
  if (options.sigma_s_prime_per_mm && !(options.sigma_s_prime_per_mm->low > 0.0)) {
    throw std::invalid_argument("plan: sigma_s' from 0");
  }
  Plan out;
  Stopwatch watch(out.timing_s);
  Rig rig = planned_rig(given);
  out.neutral_camera =
      rig.decoding.radiance != nullptr && rig.decoding.radiance != given.decoding.radiance;
  if (rig.pose.charuco && !rig.pose.board_shot.empty()) {
    calib::take_points_from_board_shot(board_frame(rig), rig.pose.board_shot, rig.pose);
  }
  out.from_truth = !options.sigma_s_prime_per_mm && !options.sigma_a_per_mm;
  out.calibrated_noise = rig.decoding.radiance != nullptr;
  out.noise = noise_of(rig);
  out.brightness_known = rig.scene.camera.responsivity.has_value();
  MeasureOptions measure_options;
  measure_options.patch_size_mm = options.patch_size_mm;
  Instrument instrument(rig, scenes, measure_options, options.progress);
  watch.lap("geometry");
  const std::vector<TruthMaterials> materials = expected_materials(rig, options);
  if (options.rendered != nullptr && !out.from_truth) {
    throw std::invalid_argument("plan: rendered shots are those of the rig's truth");
  }
  std::vector<ObservedShot> opened;
  std::array<double, kRgb> responsivity{};
  const double range_counts =
      capture::VirtualSensor(rig.scene, rig.truth.sensor, false).range_counts();
  for (std::size_t k = 0; k < materials.size(); ++k) {
    Rig truth = rig;
    truth.truth.materials = materials[k];
    std::optional<VirtualShots> own;
    if (options.rendered == nullptr) {
      own.emplace(truth, scenes, VirtualShotOptions{.noise = false, .progress = options.progress});
    }
    const VirtualShots& shots = own ? *own : *options.rendered;
    watch.lap("rendering");
    const capture::FrameSource frames = [&](std::size_t i, std::size_t e) {
      return shots.expected_frame(i, e);
    };
    std::vector<ObservedShot> of_corner;
    const Measurement m =
        instrument.forecast(capture::shots_from(rig.scene, capture::all_shots(rig.scene), frames),
                            k == 0 ? opened : of_corner);
    out.patch_size_mm = m.patch_size_mm;
    if (k == 0) out.channels.resize(m.results.size());
    for (std::size_t r = 0; r < m.results.size(); ++r) {
      const ChannelResult& result = m.results[r];
      Medium medium = materials[k].at(result.material)[channel_index(result.channel)];
      medium.eta_int_over_ext = result.eta_int_over_ext;
      if (k == 0) {
        out.channels[r].expected = {medium, result.estimate};
        out.channels[r].result = result;
      } else {
        out.channels[r].corners.push_back({medium, result.estimate});
      }
    }
    if (k == 0) {
      out.exposures = exposure_advice(rig, shots, opened, out.noise, range_counts);
      responsivity = shots.responsivity();
    }
    watch.lap("forecast");
  }
  if (options.other_shots) {
    double coarse_mm = 0.0;
    double measured_mm = 0.0;
    for (const auto& [name, scene] : scenes) {
      measured_mm = std::max(measured_mm, out.patch_size_mm.at(name));
      coarse_mm = std::max({coarse_mm, scene.size_mm() / kCoarsePatches, measured_mm});
    }
    CoarseShots coarse(rig, scenes, opened, coarse_mm, measured_mm, responsivity, out.noise,
                       range_counts);
    out.other_shots = other_shots(rig, other_tasks(rig, materials.front(), out.channels),
                                  scale_prior(rig.scene), coarse, options.progress);
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
