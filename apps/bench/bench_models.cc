#include "apps/bench/bench_models.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <exception>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "apps/bench/estimate_statistics.h"
#include "apps/instrument/instrument.h"
#include "apps/instrument/open_shots.h"
#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/volume_truth.h"
#include "core/base/progress.h"
#include "core/camera/channel_index.h"
#include "core/mesh/bodies.h"
#include "core/transport/volume_light.h"

namespace scattermeter::apps {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr Quantity kNoQuantity{kMissing, kMissing, kMissing, kMissing};

// One material and channel on one body, with light in this channel only.
struct Case {
  Rig truth;
  Rig stated;
  ObjectScenes objects;
  std::size_t channel;
};

Case make_case(const std::string& body, const ListedMaterial& material,
               const ModelsBenchOptions& options, double scale_error) {
  Case c;
  c.channel = channel_index(material.channel);
  std::array<Medium, 3> media;
  media.fill(material.medium);
  c.truth = bodies_rig(options.image_width_px, material.medium.eta_int_over_ext,
                       {{material.name, media}}, {body});
  for (SceneLight& light : c.truth.scene.lights) {
    for (std::size_t other = 0; other < 3; ++other) {
      if (other != c.channel) {
        light.led()->led.intensity_W_per_sr[static_cast<Eigen::Index>(other)] = 0.0;
      }
    }
  }
  c.stated = c.truth;
  c.stated.scene.camera.responsivity_relative_std = options.scale_std;
  for (double& r : *c.stated.scene.camera.responsivity)
    r *= std::exp(options.scale_std * scale_error);
  return c;
}

double measured_patch_mm(const Case& c, const std::string& body) {
  const double distance_mm =
      (c.truth.truth.pose->position_mm - c.objects.at(body).box.center_mm()).norm();
  return LitObjects(c.stated.scene, c.objects, std::nullopt, distance_mm).smallest_patch_mm();
}

// Measures wall and processor time since its construction.
class Clocks {
 public:
  void stop(ModelsBenchRow& row) const {
    row.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start_).count();
    row.cpu_seconds = static_cast<double>(std::clock() - cpu_start_) / CLOCKS_PER_SEC;
  }

 private:
  std::chrono::steady_clock::time_point wall_start_ = std::chrono::steady_clock::now();
  std::clock_t cpu_start_ = std::clock();
};

ModelsBenchRow empty_row(const std::string& body, const ListedMaterial& material) {
  ModelsBenchRow row;
  row.body = body;
  row.material = material;
  row.sigma_s_prime_per_mm = row.sigma_a_per_mm = kNoQuantity;
  for (double* number :
       {&row.truth_std_sigma_s_prime_per_mm, &row.truth_std_sigma_a_per_mm, &row.truth_patch_std,
        &row.error_sigma_s_prime, &row.error_sigma_a, &row.monte_carlo_share, &row.z_sigma_s_prime,
        &row.z_sigma_a, &row.seconds, &row.cpu_seconds}) {
    *number = kMissing;
  }
  return row;
}

void judge(const ChannelResult& result, ModelsBenchRow& row) {
  if (result.refused()) {
    row.status = ModelsBenchStatus::kRefused;
    row.reason = result.estimate.reasons.front();
  }
  if (!result.estimate.converged) return;
  const Medium& truth = row.material.medium;
  row.sigma_s_prime_per_mm = result.estimate.sigma_s_prime_per_mm;
  row.sigma_a_per_mm = result.estimate.sigma_a_per_mm;
  row.error_sigma_s_prime = row.sigma_s_prime_per_mm.value / truth.sigma_s_prime_per_mm - 1.0;
  row.error_sigma_a = row.sigma_a_per_mm.value / truth.sigma_a_per_mm - 1.0;
  for (const BudgetLine& line : result.estimate.budget) {
    if (line.cause != "Monte Carlo") continue;
    row.monte_carlo_share =
        std::pow(std::max(line.std_sigma_s_prime_per_mm / row.sigma_s_prime_per_mm.std,
                          line.std_sigma_a_per_mm / row.sigma_a_per_mm.std),
                 2);
  }
  const auto z = [](const Quantity& q, double t, double truth_std) {
    return (q.value - t) / std::hypot(q.std, truth_std);
  };
  row.z_sigma_s_prime =
      z(row.sigma_s_prime_per_mm, truth.sigma_s_prime_per_mm, row.truth_std_sigma_s_prime_per_mm);
  row.z_sigma_a = z(row.sigma_a_per_mm, truth.sigma_a_per_mm, row.truth_std_sigma_a_per_mm);
}

ChannelResult measured(Instrument& instrument, const Case& c, const capture::SampleSource& source) {
  return instrument
      .measure(capture::shots_from(c.stated.scene, capture::all_shots(c.stated.scene), source))
      .results.at(c.channel);
}

// Sets the effect of the shots' Monte Carlo error; it remains NaN if the dipole does not converge
// on the image of the truth.
void judge_truth(const VolumeTruth& shots, const Case& c, ModelsBenchRow& row) {
  row.truth_patch_std = shots.patch_std();
  const MeasureOptions options;
  Instrument instrument(c.stated, c.objects, options);
  std::vector<double> s, a;
  for (int b = 0; b < shots.batches(); ++b) {
    const Estimate e = measured(instrument, c, shots.disturbed(b)).estimate;
    if (!e.converged) return;
    s.push_back(e.sigma_s_prime_per_mm.value);
    a.push_back(e.sigma_a_per_mm.value);
  }
  row.truth_std_sigma_s_prime_per_mm = sampled_std(s);
  row.truth_std_sigma_a_per_mm = sampled_std(a);
}

std::vector<ModelsBenchRow> rows_of_case(const std::string& body, const ListedMaterial& material,
                                         const ModelsBenchOptions& options,
                                         std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  const std::uint64_t seed = generator();
  const std::uint64_t noise_seed = generator();
  const double scale_error = normal(generator);
  ModelsBenchRow common = empty_row(body, material);
  try {
    Case c = make_case(body, material, options, scale_error);
    c.objects = bodies_scenes(c.truth);
    common.reason =
        why_left_out(material.medium, c.objects.at(body).box, measured_patch_mm(c, body));
    if (!common.reason.empty()) {
      common.status = ModelsBenchStatus::kLeftOut;
      return {common};
    }
    VolumeTruthOptions truth_options;
    truth_options.paths = options.paths;
    // The renderer multiplies it by 1000003; seeds of transport are below 100000.
    truth_options.seed = seed % 1'000'000'000 + 1;
    if (options.noise) truth_options.noise_seed = noise_seed;
    const VolumeTruth shots(c.truth, c.objects, truth_options);
    judge_truth(shots, c, common);
    std::vector<ModelsBenchRow> rows;
    for (const std::string& model : options.models) {
      ModelsBenchRow row = common;
      row.model = model;
      MeasureOptions measure_options;
      measure_options.estimate.model = model;
      measure_options.estimate.time_limit_s = options.time_limit_s;
      measure_options.atlas_folder = options.atlas_folder;
      try {
        const Clocks clocks;
        Instrument instrument(c.stated, c.objects, measure_options);
        const ChannelResult result = measured(instrument, c, shots.shots());
        clocks.stop(row);
        judge(result, row);
      } catch (const std::exception& e) {
        row.status = ModelsBenchStatus::kFailed;
        row.reason = e.what();
      }
      rows.push_back(row);
    }
    return rows;
  } catch (const std::exception& e) {
    common.status = ModelsBenchStatus::kFailed;
    common.reason = e.what();
    return {common};
  }
}

}  // namespace

std::string why_left_out(const Medium& medium, const Box3d& box, double patch_size_mm) {
  const double mfp_mm = 1.0 / medium.sigma_t_prime_per_mm();
  const double decay_mm =
      1.0 / std::sqrt(3.0 * medium.sigma_a_per_mm * medium.sigma_t_prime_per_mm());
  const double thinnest_mm = box.size_mm().minCoeff();
  if (mfp_mm > thinnest_mm / 3.0) {
    return fmt::format("mean free path {:.2f} mm, more than a third of {:.0f} mm", mfp_mm,
                       thinnest_mm);
  }
  const double resolved_mm =
      std::max(volume_patch_size_mm(mfp_mm, box.size_mm().maxCoeff()), patch_size_mm / 3.0);
  if (mfp_mm < resolved_mm) {
    return fmt::format("mean free path {:.3f} mm, patches resolve {:.3f} mm", mfp_mm, resolved_mm);
  }
  if (decay_mm < 0.75 * patch_size_mm) {
    return fmt::format("light dies off within {:.2f} mm, patches are {:.2f} mm", decay_mm,
                       patch_size_mm);
  }
  return "";
}

std::vector<ModelsBenchRow> bench_models(const std::vector<ListedMaterial>& list,
                                         const ModelsBenchOptions& options) {
  if (!(options.scale_std >= 0.0)) {
    throw std::invalid_argument("bench_models: scale_std " + std::to_string(options.scale_std));
  }
  for (const std::string& body : options.bodies) body_mesh(body);
  std::vector<ModelsBenchRow> rows;
  ProgressStage stage(options.progress, "models", options.bodies.size() * list.size());
  for (const std::string& body : options.bodies) {
    // One stream per body, so that it does not depend on the others.
    const auto number = std::find(body_names().begin(), body_names().end(), body);
    std::seed_seq words{options.seed & 0xFFFFFFFFU, options.seed >> 32,
                        static_cast<std::uint64_t>(number - body_names().begin())};
    std::mt19937_64 generator(words);
    for (const ListedMaterial& material : list) {
      const std::vector<ModelsBenchRow> more = rows_of_case(body, material, options, generator);
      rows.insert(rows.end(), more.begin(), more.end());
      if (options.after_case) options.after_case(rows);
      stage.step();
    }
  }
  return rows;
}

}  // namespace scattermeter::apps
