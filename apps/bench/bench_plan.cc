#include "apps/bench/bench_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "apps/instrument/instrument.h"
#include "apps/planning/plan.h"
#include "apps/report/csv.h"
#include "apps/report/text_table.h"
#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/synthetic_camera.h"
#include "apps/simulation/virtual_shots.h"
#include "core/base/median.h"
#include "core/base/progress.h"
#include "core/base/random_stream.h"
#include "core/mesh/bodies.h"

namespace scattermeter::apps {
namespace {

double log_uniform(RandomStream& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

template <class T, std::size_t N>
const T& one_of(RandomStream& random, const std::array<T, N>& list) {
  return list[std::min(N - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(N)))];
}

double relative_std(const Quantity& q) { return q.std / q.value; }

double ratio_or_none(double forecast, double stated) {
  return forecast > 0.0 && stated > 0.0 ? forecast / stated
                                        : std::numeric_limits<double>::quiet_NaN();
}

std::string relative_text(double relative) {
  return std::isfinite(relative) ? fmt::format("{:.3g} %", 100.0 * relative) : "-";
}

std::string ratio_text(double ratio) {
  return std::isfinite(ratio) ? fmt::format("{:.2f}", ratio) : "-";
}

}  // namespace

DrawnPlanRig draw_plan_rig(std::uint64_t seed, int image_width_px) {
  constexpr std::uint64_t kStream = 0x706c616e;
  RandomStream random(seed, kStream);
  std::vector<std::string> bodies = {
      one_of(random, std::array<std::string, 5>{"cube", "pyramid", "sphere", "slab", "scan"})};
  if (random.uniform() < 0.3) bodies.push_back(bodies[0] == "cube" ? "pyramid" : "cube");
  std::array<Medium, 3> media;
  for (Medium& m : media) {
    m = {log_uniform(random, 0.6, 2.2), log_uniform(random, 0.001, 0.02), 1.0};
  }
  const double eta = 1.3 + 0.2 * random.uniform();
  DrawnPlanRig out{bodies_rig(image_width_px, eta, {{"drawn", media}}, bodies), ""};
  Rig& rig = out.rig;
  rig.path = "";
  constexpr std::array<double, 4> kScaleStd = {0.0, 0.005, 0.02,
                                               std::numeric_limits<double>::infinity()};
  const double scale_std = one_of(random, kScaleStd);
  if (std::isfinite(scale_std)) {
    rig.scene.camera.responsivity_relative_std = scale_std;
  } else {
    rig.scene.camera.responsivity.reset();
  }
  const double eta_std = one_of(random, std::array<double, 3>{0.0, 0.0, 0.01});
  for (SceneObject& object : rig.scene.objects) object.eta_std = eta_std;
  rig.pose.options.point_std_px = one_of(random, std::array<double, 3>{0.001, 0.05, 0.15});
  const double position_std_mm = one_of(random, std::array<double, 3>{0.0, 0.1, 0.5});
  const double power_std = one_of(random, std::array<double, 3>{0.0, 0.005, 0.02});
  const double exponent_std = one_of(random, std::array<double, 2>{0.0, 0.05});
  // Mostly on the camera's half of the upper hemisphere.
  const int n_leds = 1 + static_cast<int>(3.0 * random.uniform());
  rig.scene.lights.clear();
  for (int k = 0; k < n_leds; ++k) {
    const double zenith = (15.0 + 60.0 * random.uniform()) * std::numbers::pi / 180.0;
    const double azimuth =
        (-90.0 + 130.0 * (2.0 * random.uniform() - 1.0)) * std::numbers::pi / 180.0;
    const double distance_mm = 70.0 + 60.0 * random.uniform();
    const Eigen::Vector3d position_mm =
        Eigen::Vector3d(0, 0, 9) +
        distance_mm * Eigen::Vector3d(std::sin(zenith) * std::cos(azimuth),
                                      std::sin(zenith) * std::sin(azimuth), std::cos(zenith));
    SceneLight light = synthetic_led("led" + std::to_string(k + 1), position_mm,
                                     Eigen::Vector3d(0, 0, 9) - position_mm);
    light.led()->position_std_mm = position_std_mm;
    light.led()->intensity_relative_std = power_std;
    light.led()->exponent_std = exponent_std;
    rig.scene.lights.push_back(light);
  }
  rig.scene.shots.clear();
  for (const std::string& body : bodies) {
    for (const SceneLight& light : rig.scene.lights) {
      SceneShot shot;
      shot.file = body + "_" + light.name + ".dng";
      shot.object = body;
      shot.material = "drawn";
      shot.lights = {light.name};
      rig.scene.shots.push_back(shot);
    }
  }
  out.setting =
      bodies[0] + (bodies.size() > 1 ? "+" + bodies[1] : "") +
      fmt::format(", {} LED{}, scale {}", n_leds, n_leds > 1 ? "s" : "",
                  std::isfinite(scale_std) ? fmt::format("{:g} %", 100.0 * scale_std) : "free");
  return out;
}

std::vector<PlanBenchRow> plan_and_measure(const Rig& rig, const ObjectScenes& objects,
                                           std::uint64_t seed) {
  PlanOptions options;
  options.suggested_shots = false;
  const VirtualShots shots(rig, objects, {.noise = true});
  options.rendered = &shots;
  const Plan planned = plan(rig, objects, options);
  Instrument instrument(rig, objects, {});
  const Measurement m = instrument.measure(shots.source(seed));
  std::vector<PlanBenchRow> rows(m.results.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const ChannelResult& forecast = planned.channels.at(r).result;
    const ChannelResult& stated = m.results[r];
    PlanBenchRow& row = rows[r];
    row.channel = stated.channel;
    row.planned = !forecast.refused();
    row.measured = !stated.refused();
    if (row.planned != row.measured) {
      row.reasons = (row.planned ? stated : forecast).estimate.reasons;
    }
    const auto of = [](const ChannelResult& result, Quantity Estimate::*coefficient) {
      return result.refused() ? std::numeric_limits<double>::quiet_NaN()
                              : relative_std(result.estimate.*coefficient);
    };
    row.forecast_sigma_s_prime = of(forecast, &Estimate::sigma_s_prime_per_mm);
    row.stated_sigma_s_prime = of(stated, &Estimate::sigma_s_prime_per_mm);
    row.forecast_sigma_a = of(forecast, &Estimate::sigma_a_per_mm);
    row.stated_sigma_a = of(stated, &Estimate::sigma_a_per_mm);
  }
  return rows;
}

std::vector<PlanBenchRow> bench_plan(const PlanBenchOptions& options) {
  if (options.rigs < 1) {
    throw std::invalid_argument("bench_plan: at least one rig expected, got " +
                                std::to_string(options.rigs));
  }
  std::vector<PlanBenchRow> out;
  ProgressStage stage(options.progress, "rigs", static_cast<std::size_t>(options.rigs));
  for (int i = 0; i < options.rigs; ++i) {
    const std::uint64_t seed = options.seed * 1000 + static_cast<std::uint64_t>(i);
    const DrawnPlanRig drawn = draw_plan_rig(seed, options.image_width_px);
    const ObjectScenes objects = bodies_scenes(drawn.rig);
    for (PlanBenchRow& row : plan_and_measure(drawn.rig, objects, seed)) {
      row.rig = i + 1;
      row.setting = drawn.setting;
      out.push_back(row);
    }
    stage.step();
  }
  return out;
}

PlanBenchRatios plan_bench_ratios(const std::vector<PlanBenchRow>& rows) {
  std::vector<double> ratios;
  for (const PlanBenchRow& row : rows) {
    for (const double ratio : {ratio_or_none(row.forecast_sigma_s_prime, row.stated_sigma_s_prime),
                               ratio_or_none(row.forecast_sigma_a, row.stated_sigma_a)}) {
      if (std::isfinite(ratio)) ratios.push_back(ratio);
    }
  }
  PlanBenchRatios out;
  out.n = ratios.size();
  if (ratios.empty()) return out;
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  out.least = *least;
  out.most = *most;
  out.median = upper_median(ratios);
  return out;
}

std::string plan_bench_table(const std::vector<PlanBenchRow>& rows) {
  using Align = TextTable::Align;
  TextTable table({{"rig"},
                   {"drawn", Align::kLeft},
                   {"ch", Align::kLeft},
                   {"sigma_s': forecast"},
                   {"stated"},
                   {"ratio"},
                   {"sigma_a: forecast"},
                   {"stated"},
                   {"ratio"},
                   {"verdict", Align::kLeft}});
  int last = 0;
  std::size_t differ = 0;
  for (const PlanBenchRow& row : rows) {
    const bool same = row.planned == row.measured;
    differ += same ? 0 : 1;
    table.add_row({row.rig == last ? "" : std::to_string(row.rig),
                   row.rig == last ? "" : row.setting, std::string(1, row.channel),
                   relative_text(row.forecast_sigma_s_prime),
                   relative_text(row.stated_sigma_s_prime),
                   ratio_text(ratio_or_none(row.forecast_sigma_s_prime, row.stated_sigma_s_prime)),
                   relative_text(row.forecast_sigma_a), relative_text(row.stated_sigma_a),
                   ratio_text(ratio_or_none(row.forecast_sigma_a, row.stated_sigma_a)),
                   same ? (row.planned ? "ok" : "refused, as forecast")
                        : (row.planned ? "refused, not forecast" : "ok, refusal forecast")});
    last = row.rig;
  }
  const PlanBenchRatios r = plan_bench_ratios(rows);
  std::string text =
      table.text() +
      fmt::format(
          "forecast over stated deviation, {} values: median {:.3f}, {:.3f} to {:.3f}; "
          "{} of {} verdicts differ\n",
          r.n, r.median, r.least, r.most, differ, rows.size());
  for (const PlanBenchRow& row : rows) {
    for (const std::string& reason : row.reasons) {
      text += fmt::format("rig {}, {}, {}: {}\n", row.rig, row.setting, row.channel, reason);
    }
  }
  return text;
}

std::string plan_bench_csv(const std::vector<PlanBenchRow>& rows) {
  Csv csv({"rig", "drawn", "channel", "forecast", "measured", "sigma_s_prime_forecast_relative",
           "sigma_s_prime_stated_relative", "sigma_a_forecast_relative",
           "sigma_a_stated_relative"});
  for (const PlanBenchRow& row : rows) {
    csv.add_row({std::to_string(row.rig), row.setting, std::string(1, row.channel),
                 row.planned ? "ok" : "refused", row.measured ? "ok" : "refused",
                 csv_number(row.forecast_sigma_s_prime), csv_number(row.stated_sigma_s_prime),
                 csv_number(row.forecast_sigma_a), csv_number(row.stated_sigma_a)});
  }
  return csv.text();
}

Plot plan_bench_plot(const std::vector<PlanBenchRow>& rows) {
  PlotSeries s{"sigma_s'", PlotSeries::Style::kPoints, {}, {}, {}, 0};
  PlotSeries a{"sigma_a", PlotSeries::Style::kOpenPoints, {}, {}, {}, 1};
  PlotSeries line{"equal", PlotSeries::Style::kDashedLine, {}, {}, {}, 6};
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  const auto add = [&](PlotSeries& series, double forecast, double stated) {
    if (!std::isfinite(ratio_or_none(forecast, stated))) return;
    series.x.push_back(100.0 * forecast);
    series.y.push_back(100.0 * stated);
    least = std::min(least, 100.0 * forecast);
    most = std::max(most, 100.0 * forecast);
  };
  for (const PlanBenchRow& row : rows) {
    add(s, row.forecast_sigma_s_prime, row.stated_sigma_s_prime);
    add(a, row.forecast_sigma_a, row.stated_sigma_a);
  }
  line.x = line.y = {least, most};
  Plot plot;
  plot.title = "Forecast against stated standard deviations";
  plot.x = {"forecast [% of the coefficient]", true};
  plot.y = {"stated by measure [%]", true};
  plot.series = {line, s, a};
  plot.legend_above = true;
  return plot;
}

}  // namespace scattermeter::apps
