#include "apps/bench/bench_materials.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/instrument/instrument.h"
#include "apps/report/csv.h"
#include "apps/report/text_table.h"
#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "core/base/progress.h"
#include "core/camera/channel_index.h"

namespace scattermeter::apps {
namespace {

// An estimate with a smaller relative error is right whatever its standard deviation.
constexpr double kNearS = 0.01;
constexpr double kNearA = 0.05;
constexpr double kFar = 3.0;  // standard deviations

const char* verdict_name(MaterialVerdict verdict) {
  switch (verdict) {
    case MaterialVerdict::kRight:
      return "ok";
    case MaterialVerdict::kWrong:
      return "WRONG";
    case MaterialVerdict::kRefused:
      return "refused";
  }
  throw std::invalid_argument("verdict_name: no such verdict");
}

MaterialsBenchRow judged(const ListedMaterial& material, double scale_std, const Estimate& e) {
  MaterialsBenchRow row{material, scale_std, e, 0, 0, 0, 0, MaterialVerdict::kRefused};
  const Medium& truth = material.medium;
  const auto error = [](const Quantity& q, double t) { return q.value / t - 1.0; };
  const auto z = [](const Quantity& q, double t) { return (q.value - t) / q.std; };
  row.error_sigma_s_prime = error(e.sigma_s_prime_per_mm, truth.sigma_s_prime_per_mm);
  row.error_sigma_a = error(e.sigma_a_per_mm, truth.sigma_a_per_mm);
  row.z_sigma_s_prime = z(e.sigma_s_prime_per_mm, truth.sigma_s_prime_per_mm);
  row.z_sigma_a = z(e.sigma_a_per_mm, truth.sigma_a_per_mm);
  if (!e.reasons.empty()) return row;
  // Values that are not finite are wrong, too.
  const auto right = [](double off, double near, double deviations) {
    return std::abs(off) <= near || std::abs(deviations) <= kFar;
  };
  row.verdict = right(row.error_sigma_s_prime, kNearS, row.z_sigma_s_prime) &&
                        right(row.error_sigma_a, kNearA, row.z_sigma_a)
                    ? MaterialVerdict::kRight
                    : MaterialVerdict::kWrong;
  return row;
}

std::vector<std::string> names_of(const std::vector<ListedMaterial>& list) {
  std::vector<std::string> names;
  for (const ListedMaterial& m : list) {
    if (std::find(names.begin(), names.end(), m.name) == names.end()) names.push_back(m.name);
  }
  return names;
}

double reduced_albedo(const Medium& m) {
  return m.sigma_s_prime_per_mm / (m.sigma_s_prime_per_mm + m.sigma_a_per_mm);
}

}  // namespace

std::vector<MaterialsBenchRow> bench_materials(const std::vector<ListedMaterial>& list,
                                               const MaterialsBenchOptions& options) {
  for (double std : options.scale_stds) {
    if (!(std >= 0.0)) {
      throw std::invalid_argument("bench_materials: scale_std " + std::to_string(std));
    }
  }
  std::vector<MaterialsBenchRow> rows;
  std::mt19937_64 generator(options.seed);
  std::normal_distribution<double> normal;
  const std::vector<std::string> names = names_of(list);
  ProgressStage stage(options.progress, "materials", names.size());
  for (const std::string& name : names) {
    std::vector<ListedMaterial> channels;
    std::copy_if(list.begin(), list.end(), std::back_inserter(channels),
                 [&](const ListedMaterial& m) { return m.name == name; });
    std::array<Medium, 3> media;
    media.fill(channels.front().medium);
    for (const ListedMaterial& m : channels) media[channel_index(m.channel)] = m.medium;
    const Rig truth = bodies_rig(options.image_width_px, channels.front().medium.eta_int_over_ext,
                                 {{name, media}});
    const ObjectScenes objects = bodies_scenes(truth);
    const VirtualShots shots(truth, objects, {.noise = true});
    std::vector<capture::RawFrame> exposed(shots.size());
    const std::uint64_t seed = generator();  // of its own for each material
    tbb::parallel_for(std::size_t{0}, shots.size(),
                      [&](std::size_t i) { exposed[i] = shots.frame(i, seed); });
    const double z = normal(generator);
    for (double scale_std : options.scale_stds) {
      Rig stated = truth;
      stated.scene.camera.responsivity_relative_std = scale_std;
      for (double& r : *stated.scene.camera.responsivity) r *= std::exp(scale_std * z);
      Instrument instrument(stated, objects, {});
      const Measurement m = instrument.measure(capture::shots_from(
          stated.scene, capture::all_shots(stated.scene),
          capture::FrameSource([&](std::size_t i, std::size_t) { return exposed.at(i); })));
      for (const ListedMaterial& material : channels) {
        rows.push_back(
            judged(material, scale_std, m.results.at(channel_index(material.channel)).estimate));
      }
    }
    stage.step();
  }
  return rows;
}

std::string materials_bench_table(const std::vector<MaterialsBenchRow>& rows) {
  using Align = TextTable::Align;
  TextTable table({{"material", Align::kLeft},
                   {"ch", Align::kLeft},
                   {"sigma_s'"},
                   {"sigma_a"},
                   {"alpha'"},
                   {"scale known to"},
                   {"sigma_s' error %"},
                   {"z"},
                   {"sigma_a error %"},
                   {"z"},
                   {"verdict", Align::kLeft}});
  std::vector<double> counts(3, 0.0);
  for (const MaterialsBenchRow& r : rows) {
    const Medium& m = r.material.medium;
    counts[static_cast<std::size_t>(r.verdict)] += 1.0;
    table.add_row(
        {r.material.name, std::string(1, r.material.channel),
         fmt::format("{:g}", m.sigma_s_prime_per_mm), fmt::format("{:g}", m.sigma_a_per_mm),
         fmt::format("{:.3f}", reduced_albedo(m)), fmt::format("{:g} %", 100.0 * r.scale_std),
         fmt::format("{:+.3f} ± {:.3f}", 100.0 * r.error_sigma_s_prime,
                     100.0 * r.estimate.sigma_s_prime_per_mm.std / m.sigma_s_prime_per_mm),
         fmt::format("{:+.1f}", r.z_sigma_s_prime),
         fmt::format("{:+.3f} ± {:.3f}", 100.0 * r.error_sigma_a,
                     100.0 * r.estimate.sigma_a_per_mm.std / m.sigma_a_per_mm),
         fmt::format("{:+.1f}", r.z_sigma_a),
         verdict_name(r.verdict) +
             (r.estimate.reasons.empty() ? "" : ": " + r.estimate.reasons.front())});
  }
  return table.text() + fmt::format("{:.0f} right, {:.0f} wrong, {:.0f} refused\n", counts[0],
                                    counts[1], counts[2]);
}

std::string materials_bench_csv(const std::vector<MaterialsBenchRow>& rows) {
  Csv csv({"material", "channel", "eta", "truth_sigma_s_prime_per_mm", "truth_sigma_a_per_mm",
           "scale_std", "sigma_s_prime_per_mm", "sigma_s_prime_std_per_mm", "sigma_s_prime_z",
           "sigma_a_per_mm", "sigma_a_std_per_mm", "sigma_a_z", "reduced_chi2", "verdict",
           "reason"});
  for (const MaterialsBenchRow& r : rows) {
    const Medium& m = r.material.medium;
    const Estimate& e = r.estimate;
    csv.add_row(
        {r.material.name, std::string(1, r.material.channel), csv_number(m.eta_int_over_ext),
         csv_number(m.sigma_s_prime_per_mm), csv_number(m.sigma_a_per_mm), csv_number(r.scale_std),
         csv_number(e.sigma_s_prime_per_mm.value), csv_number(e.sigma_s_prime_per_mm.std),
         csv_number(r.z_sigma_s_prime), csv_number(e.sigma_a_per_mm.value),
         csv_number(e.sigma_a_per_mm.std), csv_number(r.z_sigma_a), csv_number(e.reduced_chi2),
         verdict_name(r.verdict), e.reasons.empty() ? "" : e.reasons.front()});
  }
  return csv.text();
}

}  // namespace scattermeter::apps
