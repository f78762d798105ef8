// bench materials: known materials, strong to weak scatterers: right, wrong or refused?
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/bench/material_list.h"
#include "core/base/progress.h"
#include "core/fit/estimate.h"

namespace scattermeter::apps {

struct MaterialsBenchOptions {
  int image_width_px = 968;
  std::uint64_t seed = 1;                        // of the noise and of the scale's errors
  std::vector<double> scale_stds = {0.0, 0.02};  // relative, >= 0; stated for the fit
  Progress* progress = nullptr;
};

enum class MaterialVerdict {
  kRight,  // each coefficient within 3 stated deviations, or within 1 % (sigma_s') or 5 % (sigma_a)
  kWrong,  // not so
  kRefused,
};

struct MaterialsBenchRow {
  ListedMaterial material;
  double scale_std = 0;
  Estimate estimate;
  double error_sigma_s_prime = 0;  // estimate / truth - 1
  double error_sigma_a = 0;
  double z_sigma_s_prime = 0;  // (estimate - truth) / stated standard deviation
  double z_sigma_a = 0;
  MaterialVerdict verdict = MaterialVerdict::kRefused;
};

// Simulates each material of the list (its channels together; channels that are not listed have the
// first one's medium and are not reported) on cube and pyramid under two LEDs
// (apps/simulation/bodies_rig.h), with one noisy 12-bit exposure per shot, and measures them
// jointly once per scale_std. The stated scale has a normal error of that standard deviation, drawn
// per name. Throws std::invalid_argument for a negative scale_std.
std::vector<MaterialsBenchRow> bench_materials(const std::vector<ListedMaterial>& list,
                                               const MaterialsBenchOptions& options);

std::string materials_bench_table(const std::vector<MaterialsBenchRow>& rows);
std::string materials_bench_csv(const std::vector<MaterialsBenchRow>& rows);

}  // namespace scattermeter::apps
