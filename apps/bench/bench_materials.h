// bench materials: known materials, strong to weak scatterers: is every answer right, or refused?
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
  std::vector<double> scale_stds = {0.0, 0.02};  // relative, >= 0; the fit is told of them
  Progress* progress = nullptr;
};

enum class MaterialVerdict {
  kRight,  // answered, each coefficient within 3 stated deviations or 1 % (sigma_s'), 5 % (sigma_a)
  kWrong,  // answered, and not so
  kRefused,
};

struct MaterialsBenchRow {
  ListedMaterial material;
  double scale_std = 0;
  Estimate estimate;
  double error_sigma_s_prime = 0;  // answer / truth - 1
  double error_sigma_a = 0;
  double z_sigma_s_prime = 0;  // (answer - truth) / stated deviation
  double z_sigma_a = 0;
  MaterialVerdict verdict = MaterialVerdict::kRefused;
};

// Each name of the list (its channels at once; those that are not listed are shot as the first and
// not reported) on cube and pyramid under two LEDs (apps/simulation/bodies_rig.h): one 12-bit
// exposure with noise a shot, measured jointly once per scale_std. The scale that the rig is told
// is off by a normal error of that deviation, drawn per name. std::invalid_argument for a negative
// scale_std.
std::vector<MaterialsBenchRow> bench_materials(const std::vector<ListedMaterial>& list,
                                               const MaterialsBenchOptions& options);

std::string materials_bench_table(const std::vector<MaterialsBenchRow>& rows);
std::string materials_bench_csv(const std::vector<MaterialsBenchRow>& rows);

}  // namespace scattermeter::apps
