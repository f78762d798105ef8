#include "apps/bench/bench_rig.h"

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/bench/pull_plot.h"
#include "apps/instrument/instrument.h"
#include "apps/report/csv.h"
#include "apps/report/text_table.h"
#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/plastics_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "core/base/progress.h"

namespace scattermeter::apps {
namespace {

// The rig that is used for measuring, and the true one.
struct DrawnRigs {
  Rig stated;
  Rig truth;
};

DrawnRigs draw_rigs(const Rig& exact, const RigBenchOptions& options, int draw) {
  std::seed_seq words{options.seed & 0xffffffffU, options.seed >> 32U,
                      static_cast<std::uint64_t>(draw)};
  std::mt19937_64 generator(words);
  std::normal_distribution<double> normal;
  DrawnRigs rigs{exact, exact};
  for (std::size_t i = 0; i < exact.scene.lights.size(); ++i) {
    SceneLight& stated = rigs.stated.scene.lights[i];
    stated.led()->position_std_mm = options.led_position_std_mm;
    stated.led()->intensity_relative_std = options.led_power_relative_std;
    Led& led = rigs.truth.scene.lights[i].led()->led;
    for (int k = 0; k < 3; ++k) {
      led.position_mm[k] += options.led_position_std_mm * normal(generator);
    }
    led.intensity_W_per_sr *= 1.0 + options.led_power_relative_std * normal(generator);
  }
  for (PointPair& pair : rigs.stated.pose.points) {
    for (int k = 0; k < 2; ++k) pair.image_px[k] += options.point_std_px * normal(generator);
  }
  if (options.point_std_px > 0.0) rigs.stated.pose.options.point_std_px = options.point_std_px;
  rigs.stated.pose.options.inlier_px = std::max(2.0, 8.0 * options.point_std_px);
  return rigs;
}

// Estimates of one material and channel.
struct RigEstimates {
  std::vector<DrawnEstimate> joint_s, joint_a;
  std::vector<double> variation_s, variation_a;  // of single shots, one per draw
  double single = 0, refused_single = 0, joint = 0, refused_joint = 0;
};
using EstimatesByResult = std::map<std::pair<std::string, char>, RigEstimates>;

void measure_jointly(Instrument& instrument, const Rig& rig, const capture::FrameSource& frames,
                     EstimatesByResult& estimates) {
  const Measurement m =
      instrument.measure(capture::shots_from(rig.scene, capture::all_shots(rig.scene), frames));
  for (const ChannelResult& result : m.results) {
    RigEstimates& a = estimates[{result.material, result.channel}];
    a.joint += 1.0;
    if (result.refused()) {
      a.refused_joint += 1.0;
      continue;
    }
    const NoiseStd noise = noise_std(result.estimate);
    a.joint_s.push_back({result.estimate.sigma_s_prime_per_mm, noise.sigma_s_prime_per_mm});
    a.joint_a.push_back({result.estimate.sigma_a_per_mm, noise.sigma_a_per_mm});
  }
}

void measure_one_by_one(Instrument& instrument, const Rig& rig, const capture::FrameSource& frames,
                        int draw, EstimatesByResult& estimates,
                        std::vector<SingleShotEstimate>& singles) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::map<std::pair<std::string, char>, std::pair<std::vector<double>, std::vector<double>>> found;
  for (std::size_t i = 0; i < rig.scene.shots.size(); ++i) {
    const Measurement m = instrument.measure(capture::shots_from(rig.scene, {i}, frames));
    for (const ChannelResult& result : m.results) {
      RigEstimates& a = estimates[{result.material, result.channel}];
      SingleShotEstimate single{rig.scene.shots[i].file, result.material, result.channel, draw,
                                result.refused(),        kNone,           kNone};
      a.single += 1.0;
      if (result.refused()) {
        a.refused_single += 1.0;
      } else {
        single.sigma_s_prime_per_mm = result.estimate.sigma_s_prime_per_mm.value;
        single.sigma_a_per_mm = result.estimate.sigma_a_per_mm.value;
        auto& [s, absorption] = found[{result.material, result.channel}];
        s.push_back(single.sigma_s_prime_per_mm);
        absorption.push_back(single.sigma_a_per_mm);
      }
      singles.push_back(single);
    }
  }
  for (const auto& [key, values] : found) {
    if (values.first.size() < 2) continue;
    estimates[key].variation_s.push_back(coefficient_of_variation(values.first));
    estimates[key].variation_a.push_back(coefficient_of_variation(values.second));
  }
}

struct NamedQuantity {
  const char* name;
  const RigBenchQuantity& quantity;
};
std::array<NamedQuantity, 2> quantities_of(const RigBenchRow& row) {
  return {{{"sigma_s'", row.sigma_s_prime_per_mm}, {"sigma_a", row.sigma_a_per_mm}}};
}

}  // namespace

RigBench bench_rig(const RigBenchOptions& options) {
  if (options.draws < 2) {
    throw std::invalid_argument("bench_rig: at least two draws expected, got " +
                                std::to_string(options.draws));
  }
  for (double std :
       {options.led_position_std_mm, options.led_power_relative_std, options.point_std_px}) {
    if (!(std >= 0.0)) {
      throw std::invalid_argument("bench_rig: a deviation is negative: " + std::to_string(std));
    }
  }
  const Rig exact = plastics_rig(options.image_width_px);
  const ObjectScenes objects = bodies_scenes(exact);
  RigBench bench;
  EstimatesByResult estimates;
  ProgressStage stage(options.progress, "draws", static_cast<std::size_t>(options.draws));
  for (int draw = 0; draw < options.draws; ++draw) {
    const DrawnRigs rigs = draw_rigs(exact, options, draw);
    const VirtualShots shots(rigs.truth, objects, {.noise = true});
    std::vector<capture::RawFrame> exposed(shots.size());
    tbb::parallel_for(std::size_t{0}, shots.size(), [&](std::size_t i) {
      exposed[i] = shots.frame(i, options.seed + static_cast<std::uint64_t>(draw));
    });
    const capture::FrameSource frames = [&](std::size_t i, std::size_t) { return exposed.at(i); };
    Instrument instrument(rigs.stated, objects, {});
    measure_jointly(instrument, rigs.stated, frames, estimates);
    measure_one_by_one(instrument, rigs.stated, frames, draw, estimates, bench.singles);
    stage.step();
  }
  for (const std::string& material : exact.scene.materials()) {
    for (std::size_t c = 0; c < kRgb; ++c) {
      const RigEstimates& a = estimates.at({material, kRgbName[c]});
      const Medium& truth = exact.truth.materials.at(material)[c];
      bench.rows.push_back(
          {material,
           kRgbName[c],
           {root_mean_square(a.variation_s),
            estimate_statistics(truth.sigma_s_prime_per_mm, a.joint_s)},
           {root_mean_square(a.variation_a), estimate_statistics(truth.sigma_a_per_mm, a.joint_a)},
           a.refused_single / a.single,
           a.refused_joint / a.joint});
    }
  }
  return bench;
}

std::string rig_bench_table(const RigBench& bench) {
  using Align = TextTable::Align;
  TextTable table({{"material", Align::kLeft},
                   {"ch", Align::kLeft},
                   {"[1/mm]", Align::kLeft},
                   {"truth"},
                   {"single shots vary by"},
                   {"refused"},
                   {"joint: bias %"},
                   {"rms error"},
                   {"predicted"},
                   {"in 95 %"},
                   {"refused"}});
  for (const RigBenchRow& row : bench.rows) {
    for (const auto& [name, q] : quantities_of(row)) {
      const EstimateStatistics& s = q.joint;
      table.add_row(
          {row.material, std::string(1, row.channel), name, fmt::format("{:.4g}", s.truth),
           fmt::format("{:.2f} %", 100.0 * q.single_shot_variation),
           fmt::format("{:.0f} %", 100.0 * row.refused_single),
           fmt::format("{:+.2f} ± {:.2f}", 100.0 * s.bias_relative, 100.0 * s.bias_relative_std),
           fmt::format("{:.2f} %", 100.0 * s.rmse / s.truth),
           fmt::format("{:.2f} %", 100.0 * s.predicted_std / s.truth),
           fmt::format("{:.0f} %", 100.0 * s.coverage95),
           fmt::format("{:.0f} %", 100.0 * row.refused_joint)});
    }
  }
  return table.text();
}

std::string rig_bench_csv(const RigBench& bench) {
  Csv csv({"material", "channel", "quantity", "truth_per_mm", "single_shot_variation",
           "single_refused", "joint_answered", "joint_mean_per_mm", "joint_bias_relative",
           "joint_bias_relative_std", "joint_sampled_std_per_mm", "joint_predicted_std_per_mm",
           "joint_rmse_per_mm", "joint_coverage95", "joint_refused"});
  for (const RigBenchRow& row : bench.rows) {
    for (const auto& [name, q] : quantities_of(row)) {
      const EstimateStatistics& s = q.joint;
      csv.add_row({row.material, std::string(1, row.channel), name, csv_number(s.truth),
                   csv_number(q.single_shot_variation), csv_number(row.refused_single),
                   std::to_string(s.n), csv_number(s.mean), csv_number(s.bias_relative),
                   csv_number(s.bias_relative_std), csv_number(s.sampled_std),
                   csv_number(s.predicted_std), csv_number(s.rmse), csv_number(s.coverage95),
                   csv_number(row.refused_joint)});
    }
  }
  return csv.text();
}

std::string single_shot_csv(const RigBench& bench) {
  Csv csv(
      {"draw", "shot", "material", "channel", "verdict", "sigma_s_prime_per_mm", "sigma_a_per_mm"});
  for (const SingleShotEstimate& a : bench.singles) {
    csv.add_row({std::to_string(a.draw), a.shot, a.material, std::string(1, a.channel),
                 a.refused ? "refused" : "ok", csv_number(a.sigma_s_prime_per_mm),
                 csv_number(a.sigma_a_per_mm)});
  }
  return csv.text();
}

Plot rig_bench_plot(const RigBench& bench) {
  std::vector<double> s, a;
  for (const RigBenchRow& row : bench.rows) {
    const std::vector<double>& from_s = row.sigma_s_prime_per_mm.joint.pulls;
    const std::vector<double>& from_a = row.sigma_a_per_mm.joint.pulls;
    s.insert(s.end(), from_s.begin(), from_s.end());
    a.insert(a.end(), from_a.begin(), from_a.end());
  }
  return pull_plot("LEDs, power and pose points drawn: errors over predicted deviations",
                   {{"sigma_s'", s}, {"sigma_a", a}});
}

}  // namespace scattermeter::apps
