#include "apps/bench/bench_patches.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <fmt/core.h>

#include "apps/instrument/instrument.h"
#include "apps/report/csv.h"
#include "apps/report/text_table.h"
#include "apps/simulation/virtual_shots.h"
#include "core/base/input_error.h"
#include "core/camera/channel_index.h"

namespace scattermeter::apps {
namespace {

constexpr double kLimitS = 1e-3;
constexpr double kLimitA = 1e-2;
constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();

// Samples of each channel that fell on the patches of a shot's map, and the number of patches.
struct SampleCount {
  std::array<double, kRgb> samples{};
  double patches = 0;
};

SampleCount count_samples(const SampleMap& map, const CfaSamples& cfa) {
  SampleCount count;
  count.patches = static_cast<double>(map.patch_of_row.size());
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                      static_cast<std::size_t>(x);
      if (map.row_of_sample[at] < 0) continue;
      count.samples[static_cast<std::size_t>(cfa.channel(map.x0 + x, map.y0 + y))] += 1.0;
    }
  }
  return count;
}

}  // namespace

std::vector<PatchesBenchRow> bench_patches(const std::string& scene, const Rig& rig,
                                           const ObjectScenes& objects,
                                           const PatchesBenchOptions& options) {
  const VirtualShots shots(rig, objects, {.noise = true, .progress = options.progress});
  std::vector<PatchesBenchRow> rows;
  for (double size_mm : options.sizes_mm) {
    MeasureOptions measure_options;
    measure_options.patch_size_mm = size_mm;
    const auto start = std::chrono::steady_clock::now();
    // By shot: what a material's patches hold.
    std::vector<SampleCount> counts(rig.scene.shots.size());
    const capture::SampleSource ideal = [&](std::size_t i, const SampleMap& where) {
      CfaSamples cfa = shots.ideal_samples(i, where.x0, where.y0, where.width, where.height);
      counts[i] = count_samples(where, cfa);
      return cfa;
    };
    Measurement m;
    try {
      Instrument instrument(rig, objects, measure_options, options.progress);
      m = instrument.measure(capture::shots_from(rig.scene, capture::all_shots(rig.scene), ideal));
    } catch (const InputError& e) {
      PatchesBenchRow row;
      row.scene = scene;
      row.patch_mm = size_mm;
      row.error_sigma_s_prime = row.error_sigma_a = kNoFigure;
      row.refusal = e.what();
      rows.push_back(row);
      continue;
    }
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (const ChannelResult& result : m.results) {
      const std::size_t channel = channel_index(result.channel);
      const Medium& truth = rig.truth.materials.at(result.material)[channel];
      const Estimate& e = result.estimate;
      PatchesBenchRow row;
      row.scene = scene;
      row.material = result.material;
      row.channel = result.channel;
      row.patch_mm = size_mm;
      row.rows = e.rows;
      double samples = 0, patches = 0;
      for (std::size_t i = 0; i < rig.scene.shots.size(); ++i) {
        if (rig.scene.shots[i].material != result.material) continue;
        samples += counts[i].samples[channel];
        patches += counts[i].patches;
      }
      row.samples_per_patch = samples / patches;
      row.error_sigma_s_prime =
          e.converged ? e.sigma_s_prime_per_mm.value / truth.sigma_s_prime_per_mm - 1.0 : kNoFigure;
      row.error_sigma_a =
          e.converged ? e.sigma_a_per_mm.value / truth.sigma_a_per_mm - 1.0 : kNoFigure;
      row.std_sigma_s_prime = e.sigma_s_prime_per_mm.std / truth.sigma_s_prime_per_mm;
      row.std_sigma_a = e.sigma_a_per_mm.std / truth.sigma_a_per_mm;
      row.psnr_db = e.psnr_db;
      row.seconds = seconds;
      if (result.refused()) row.refusal = e.reasons.front();
      rows.push_back(row);
    }
  }
  return rows;
}

std::vector<PatchesBenchSpread> patches_spread(const std::vector<PatchesBenchRow>& rows) {
  std::vector<PatchesBenchSpread> out;
  std::map<std::tuple<std::string, std::string, char>, std::size_t> place;
  struct Range {
    double low_s, high_s, low_a, high_a;
  };
  std::vector<Range> ranges;
  for (const PatchesBenchRow& row : rows) {
    if (row.material.empty()) continue;
    const auto [it, is_new] = place.try_emplace({row.scene, row.material, row.channel}, out.size());
    if (is_new) {
      out.push_back({row.scene, row.material, row.channel, 0, 0, 0, 0, true});
      ranges.push_back(
          {row.error_sigma_s_prime, row.error_sigma_s_prime, row.error_sigma_a, row.error_sigma_a});
    }
    PatchesBenchSpread& s = out[it->second];
    Range& r = ranges[it->second];
    s.worst_sigma_s_prime = std::max(s.worst_sigma_s_prime, std::abs(row.error_sigma_s_prime));
    s.worst_sigma_a = std::max(s.worst_sigma_a, std::abs(row.error_sigma_a));
    r.low_s = std::min(r.low_s, row.error_sigma_s_prime);
    r.high_s = std::max(r.high_s, row.error_sigma_s_prime);
    r.low_a = std::min(r.low_a, row.error_sigma_a);
    r.high_a = std::max(r.high_a, row.error_sigma_a);
    s.spread_sigma_s_prime = r.high_s - r.low_s;
    s.spread_sigma_a = r.high_a - r.low_a;
    s.within = s.within && row.refusal.empty() && std::abs(row.error_sigma_s_prime) <= kLimitS &&
               std::abs(row.error_sigma_a) <= kLimitA;
  }
  // A size that a whole scene refused.
  for (const PatchesBenchRow& row : rows) {
    if (!row.material.empty()) continue;
    for (PatchesBenchSpread& s : out) s.within = s.within && s.scene != row.scene;
  }
  return out;
}

std::string patches_bench_table(const std::vector<PatchesBenchRow>& rows) {
  using Align = TextTable::Align;
  TextTable table({{"scene", Align::kLeft},
                   {"material", Align::kLeft},
                   {"ch", Align::kLeft},
                   {"patch mm"},
                   {"rows"},
                   {"samples/patch"},
                   {"sigma_s' error %"},
                   {"sigma_a error %"},
                   {"PSNR dB"},
                   {"s"},
                   {"verdict", Align::kLeft}});
  const auto error = [](double value, double std) {
    return fmt::format("{:+.4f} ± {:.4f}", 100.0 * value, 100.0 * std);
  };
  for (const PatchesBenchRow& r : rows) {
    table.add_row(
        {r.scene, r.material, std::string(1, r.channel), fmt::format("{:.2f}", r.patch_mm),
         std::to_string(r.rows), fmt::format("{:.1f}", r.samples_per_patch),
         error(r.error_sigma_s_prime, r.std_sigma_s_prime), error(r.error_sigma_a, r.std_sigma_a),
         fmt::format("{:.1f}", r.psnr_db), fmt::format("{:.1f}", r.seconds),
         r.refusal.empty() ? "ok" : "refused: " + r.refusal});
  }
  TextTable spreads({{"scene", Align::kLeft},
                     {"material", Align::kLeft},
                     {"ch", Align::kLeft},
                     {"worst sigma_s' %"},
                     {"worst sigma_a %"},
                     {"spread sigma_s' %"},
                     {"spread sigma_a %"},
                     {"within 0.1 % and 1 %", Align::kLeft}});
  for (const PatchesBenchSpread& s : patches_spread(rows)) {
    spreads.add_row({s.scene, s.material, std::string(1, s.channel),
                     fmt::format("{:.4f}", 100.0 * s.worst_sigma_s_prime),
                     fmt::format("{:.4f}", 100.0 * s.worst_sigma_a),
                     fmt::format("{:.4f}", 100.0 * s.spread_sigma_s_prime),
                     fmt::format("{:.4f}", 100.0 * s.spread_sigma_a), s.within ? "yes" : "no"});
  }
  return table.text() + "\n" + spreads.text();
}

std::string patches_bench_csv(const std::vector<PatchesBenchRow>& rows) {
  Csv csv({"scene", "material", "channel", "patch_mm", "rows", "samples_per_patch",
           "sigma_s_prime_error", "sigma_a_error", "sigma_s_prime_std", "sigma_a_std", "psnr_db",
           "seconds", "refusal"});
  for (const PatchesBenchRow& r : rows) {
    csv.add_row({r.scene, r.material, std::string(1, r.channel), csv_number(r.patch_mm),
                 std::to_string(r.rows), csv_number(r.samples_per_patch),
                 csv_number(r.error_sigma_s_prime), csv_number(r.error_sigma_a),
                 csv_number(r.std_sigma_s_prime), csv_number(r.std_sigma_a), csv_number(r.psnr_db),
                 csv_number(r.seconds), r.refusal});
  }
  return csv.text();
}

}  // namespace scattermeter::apps
