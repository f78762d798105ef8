// bench models: what each model's error is on bodies of known shape and material, and its run time.
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
  kFailed,   // an exception: the body cannot be rendered (no model named) or measured
  kLeftOut,  // see why_left_out(); no model named
};

// A model's answer for a material in a channel of a body. Numbers that are not there are NaN.
struct ModelsBenchRow {
  std::string body;
  ListedMaterial material;
  std::string model;  // "paper", "dipole", "transport", or "" for all
  ModelsBenchStatus status = ModelsBenchStatus::kAnswered;
  std::string reason;               // unless answered
  Quantity sigma_s_prime_per_mm{};  // also of an answer that is refused, where there is one
  Quantity sigma_a_per_mm{};
  // The Monte Carlo error of the truth's shots, as it stands in answers
  // (apps/simulation/volume_truth.h), and relative, of a patch's light.
  double truth_std_sigma_s_prime_per_mm = 0;
  double truth_std_sigma_a_per_mm = 0;
  double truth_patch_std = 0;
  double error_sigma_s_prime = 0;  // answer / truth - 1
  double error_sigma_a = 0;
  // (answer - truth) / sqrt(stated variance + that of the truth's Monte Carlo)
  double z_sigma_s_prime = 0;
  double z_sigma_a = 0;
  double seconds = 0;      // from opened meshes to this one channel's answer, all included
  double cpu_seconds = 0;  // the same, summed over the threads
};

struct ModelsBenchOptions {
  std::vector<std::string> bodies;  // names of core/mesh/bodies.h
  std::vector<std::string> models = {"paper", "dipole", "transport"};
  int image_width_px = 968;
  std::uint64_t seed = 1;
  std::int64_t paths = 1'000'000;  // of the truth, for each light
  double time_limit_s = 50;        // of transport
  double scale_std = 0;            // relative, >= 0; told, and the error drawn from it
  bool noise = false;              // of the sensor; off: ideal samples. No rounding either way
  Progress* progress = nullptr;
  // Called with all rows so far when a case is done; a case is a material and channel of a body.
  std::function<void(const std::vector<ModelsBenchRow>&)> after_case = {};
};

// Why a material cannot tell models apart on a body with this box and these patches; "": it can.
// Left out are a mean free path 1 / sigma_t' of more than a third of the box's shortest side, one
// that the patches do not resolve (a rendered patch, volume_patch_size_mm(), or a third of a
// measured one, is longer), and light that dies off within three quarters of a measured patch
// (1 / sigma_tr).
std::string why_left_out(const Medium& medium, const Box3d& box, double patch_size_mm);

// Every body with every material and channel of the list: two shots (apps/simulation/bodies_rig.h),
// rendered by volume Monte Carlo on seeds that transport does not use, measured by every model,
// each on its own. A case that fails is a row. std::invalid_argument for an unknown body or
// scale_std < 0.
std::vector<ModelsBenchRow> bench_models(const std::vector<ListedMaterial>& list,
                                         const ModelsBenchOptions& options);

// Rows, then a summary by model and body, then what was left out.
std::string models_bench_table(const std::vector<ModelsBenchRow>& rows);
std::string models_bench_csv(const std::vector<ModelsBenchRow>& rows);
// |relative error| of answers over run time, with lines at 1 % and 5 % and, where it is known, at
// the median of what the Monte Carlo error of the shots is worth. Without any answer all series are
// empty.
Plot models_bench_plot_sigma_s_prime(const std::vector<ModelsBenchRow>& rows);
Plot models_bench_plot_sigma_a(const std::vector<ModelsBenchRow>& rows);

}  // namespace scattermeter::apps
