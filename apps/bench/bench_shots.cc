#include "apps/bench/bench_shots.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include <fmt/core.h>

#include "apps/instrument/instrument.h"
#include "apps/report/csv.h"
#include "apps/report/text_table.h"
#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/plastics_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "core/base/growth_exponent.h"
#include "core/camera/channel_index.h"

namespace scattermeter::apps {
namespace {

constexpr std::uint64_t kSeed = 1;

// plastics_rig() with its POM cube only, and n LEDs on two rings above it, one per shot.
Rig ring_rig(int image_width_px, int n) {
  Rig rig = plastics_rig(image_width_px);
  const auto is_pom_cube = [](const SceneShot& s) {
    return s.material == "POM" && s.object == "cube";
  };
  const SceneShot shot = *std::find_if(rig.scene.shots.begin(), rig.scene.shots.end(), is_pom_cube);
  SceneLight light = rig.scene.lights.front();
  light.led()->position_std_mm = 0.2;
  rig.scene.shots.clear();
  rig.scene.lights.clear();
  for (int k = 0; k < n; ++k) {
    const double turn = 2.0 * std::numbers::pi * k / n;
    const double height_mm = k % 2 == 0 ? 80.0 : 60.0;
    const Eigen::Vector3d middle_mm(0.0, 0.0, 10.0);
    light.name = fmt::format("led{}", k);
    light.led()->led.position_mm = {70.0 * std::cos(turn), 70.0 * std::sin(turn), height_mm};
    light.led()->led.axis = (middle_mm - light.led()->led.position_mm).normalized();
    rig.scene.lights.push_back(light);
    SceneShot one = shot;
    one.file = fmt::format("POM_{}.dng", k);
    one.lights = {light.name};
    rig.scene.shots.push_back(one);
  }
  return rig;
}

}  // namespace

std::vector<ShotsBenchRow> bench_shots(const ShotsBenchOptions& options) {
  if (options.repeats < 1) throw std::invalid_argument("ShotsBenchOptions.repeats");
  std::vector<ShotsBenchRow> rows;
  for (const int n : options.shots) {
    if (n < 1) throw std::invalid_argument("ShotsBenchOptions.shots");
    const Rig rig = ring_rig(options.image_width_px, n);
    const ObjectScenes objects = bodies_scenes(rig);
    const VirtualShots shots(rig, objects, {.noise = true, .progress = options.progress});
    std::vector<capture::RawFrame> frames;
    for (std::size_t i = 0; i < rig.scene.shots.size(); ++i)
      frames.push_back(shots.frame(i, kSeed));
    const capture::FrameSource source = [&](std::size_t i, std::size_t) { return frames[i]; };
    MeasureOptions measure_options;
    measure_options.estimate.model = "dipole";
    ShotsBenchRow row;
    row.shots = n;
    row.seconds = std::numeric_limits<double>::infinity();
    for (int k = 0; k < options.repeats; ++k) {
      const auto start = std::chrono::steady_clock::now();
      Instrument instrument(rig, objects, measure_options, options.progress);
      const Measurement m =
          instrument.measure(capture::shots_from(rig.scene, capture::all_shots(rig.scene), source));
      const double seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (seconds >= row.seconds) continue;
      row.seconds = seconds;
      row.timing_s = m.timing_s;
      row.error_sigma_s_prime = row.error_sigma_a = 0.0;
      row.std_sigma_s_prime = row.std_sigma_a = 0.0;
      for (const ChannelResult& r : m.results) {
        const Medium& truth = rig.truth.materials.at(r.material)[channel_index(r.channel)];
        const Quantity& s = r.estimate.sigma_s_prime_per_mm;
        const Quantity& a = r.estimate.sigma_a_per_mm;
        const auto larger = [](double& worst, double value) {
          worst = std::max(worst, std::abs(value));
        };
        larger(row.error_sigma_s_prime, s.value / truth.sigma_s_prime_per_mm - 1.0);
        larger(row.error_sigma_a, a.value / truth.sigma_a_per_mm - 1.0);
        larger(row.std_sigma_s_prime, s.std / truth.sigma_s_prime_per_mm);
        larger(row.std_sigma_a, a.std / truth.sigma_a_per_mm);
      }
    }
    rows.push_back(row);
  }
  return rows;
}

std::string shots_bench_table(const std::vector<ShotsBenchRow>& rows) {
  TextTable table(
      {{"shots"}, {"s"}, {"s a shot"}, {"worst sigma_s' error %"}, {"worst sigma_a error %"}});
  std::vector<double> n, seconds;
  for (const ShotsBenchRow& r : rows) {
    n.push_back(r.shots);
    seconds.push_back(r.seconds);
    table.add_row(
        {std::to_string(r.shots), fmt::format("{:.3f}", r.seconds),
         fmt::format("{:.4f}", r.seconds / r.shots),
         fmt::format("{:.3f} ± {:.3f}", 100.0 * r.error_sigma_s_prime, 100.0 * r.std_sigma_s_prime),
         fmt::format("{:.3f} ± {:.3f}", 100.0 * r.error_sigma_a, 100.0 * r.std_sigma_a)});
  }
  std::string text = table.text();
  if (const double exponent = growth_exponent(n, seconds); std::isfinite(exponent)) {
    text += fmt::format("\ntime grows with shots^{:.2f}\n", exponent);
  }
  return text;
}

std::string shots_bench_csv(const std::vector<ShotsBenchRow>& rows) {
  Csv csv({"shots", "seconds", "sigma_s_prime_error", "sigma_a_error", "sigma_s_prime_std",
           "sigma_a_std", "stages"});
  for (const ShotsBenchRow& r : rows) {
    std::string stages;
    for (const auto& [stage, s] : r.timing_s) stages += fmt::format("{} {:.4f} s; ", stage, s);
    csv.add_row({std::to_string(r.shots), csv_number(r.seconds), csv_number(r.error_sigma_s_prime),
                 csv_number(r.error_sigma_a), csv_number(r.std_sigma_s_prime),
                 csv_number(r.std_sigma_a), stages});
  }
  return csv.text();
}

Plot shots_bench_plot(const std::vector<ShotsBenchRow>& rows) {
  Plot plot;
  plot.title = "Measuring: run time over shots";
  plot.x = {"shots", true};
  plot.y = {"time (s)", true};
  PlotSeries series{"dipole with its uncertainty", PlotSeries::Style::kLineAndPoints, {}, {}};
  for (const ShotsBenchRow& r : rows) {
    series.x.push_back(r.shots);
    series.y.push_back(r.seconds);
  }
  plot.series.push_back(series);
  return plot;
}

}  // namespace scattermeter::apps
