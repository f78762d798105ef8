// bench models: error and run time of each model on bodies of known shape and material.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/bench/material_list.h"
#include "apps/instrument/measure.h"
#include "apps/report/plot.h"
#include "core/base/progress.h"
#include "core/fit/estimate.h"
#include "core/mesh/triangle_mesh.h"

namespace scattermeter::apps {

enum class ModelsBenchStatus {
  kAnswered,
  kRefused,  // by the model
  kFailed,   // by an exception while rendering (without a model) or measuring
  kLeftOut,  // see why_left_out(); without a model
};

// A model's estimate for a material in a channel of a body. Missing numbers are NaN.
struct ModelsBenchRow {
  std::string body;
  ListedMaterial material;
  std::string model;  // "paper", "dipole", "transport", or "" for all
  ModelsBenchStatus status = ModelsBenchStatus::kAnswered;
  std::string reason;               // unless answered
  Quantity sigma_s_prime_per_mm{};  // also if refused, as far as available
  Quantity sigma_a_per_mm{};
  // Effect of the Monte Carlo error of the rendered shots on the estimates
  // (apps/simulation/volume_truth.h), and this error itself, relative, for a patch's light.
  double truth_std_sigma_s_prime_per_mm = 0;
  double truth_std_sigma_a_per_mm = 0;
  double truth_patch_std = 0;
  double error_sigma_s_prime = 0;  // estimate / truth - 1
  double error_sigma_a = 0;
  // Share of the stated variance that is Monte Carlo's own, the larger one of both coefficients;
  // transport only.
  double monte_carlo_share = 0;
  // (estimate - truth) / sqrt(stated variance + that from the Monte Carlo error of the shots)
  double z_sigma_s_prime = 0;
  double z_sigma_a = 0;
  double seconds = 0;      // from opened meshes to the estimate of this one channel
  double cpu_seconds = 0;  // the same, summed over the threads
};

struct ModelsBenchOptions {
  std::vector<std::string> bodies;  // names of core/mesh/bodies.h
  std::vector<std::string> models = {"paper", "dipole", "transport"};
  int image_width_px = 968;
  std::uint64_t seed = 1;
  std::int64_t paths = 1'000'000;  // of the rendered shots, for each light
  double time_limit_s = 50;        // of transport
  double scale_std = 0;            // relative, >= 0; stated, and its error drawn from it
  bool noise = false;              // of the sensor; off: ideal samples. No rounding in both cases
  std::string atlas_folder;        // MeasureOptions::atlas_folder of transport
  Progress* progress = nullptr;
  // Called with all rows so far after each case: a material and channel of a body.
  std::function<void(const std::vector<ModelsBenchRow>&)> after_case = {};
};

// Why a material is unsuitable for a comparison of models on a body with this box and these
// patches; empty if it is suitable. Left out are mean free paths 1 / sigma_t' of more than a third
// of the box's shortest side or less than a rendered patch (volume_patch_size_mm()) or a third of a
// measured one, and light that dies off (1 / sigma_tr) within three quarters of a measured patch.
std::string why_left_out(const Medium& medium, const Box3d& box, double patch_size_mm);

// Every body with every material and channel of the list: two shots (apps/simulation/bodies_rig.h),
// rendered by volumetric Monte Carlo with seeds that transport does not use, measured by every
// model separately. A case that fails is a row. Throws std::invalid_argument for an unknown body or
// scale_std < 0.
std::vector<ModelsBenchRow> bench_models(const std::vector<ListedMaterial>& list,
                                         const ModelsBenchOptions& options);

// Rows, then a summary by model and body, then what was left out.
std::string models_bench_table(const std::vector<ModelsBenchRow>& rows);
std::string models_bench_csv(const std::vector<ModelsBenchRow>& rows);
// |relative error| of the estimates over run time, with lines at 1 % and 5 % and, if known, at the
// median effect of the Monte Carlo error of the shots. Without any estimate all series are empty.
Plot models_bench_plot_sigma_s_prime(const std::vector<ModelsBenchRow>& rows);
Plot models_bench_plot_sigma_a(const std::vector<ModelsBenchRow>& rows);

}  // namespace scattermeter::apps
