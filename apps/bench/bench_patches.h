// bench patches: effect of the patch size alone on the estimates.
#pragma once

#include <string>
#include <vector>

#include "apps/rig/open_objects.h"
#include "apps/rig/rig.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

struct PatchesBenchOptions {
  std::vector<double> sizes_mm = {0.1, 0.15, 0.2, 0.3, 0.4, 0.5};  // > 0
  Progress* progress = nullptr;
};

// A material and channel at a patch size.
struct PatchesBenchRow {
  std::string scene;
  std::string material;
  char channel = 'R';
  double patch_mm = 0;
  std::size_t rows = 0;            // used patches, summed over the shots
  double samples_per_patch = 0;    // of this channel, mean over the used patches
  double error_sigma_s_prime = 0;  // estimate / truth - 1; NaN without any estimate
  double error_sigma_a = 0;
  double std_sigma_s_prime = 0;  // stated, relative to the truth
  double std_sigma_a = 0;
  double psnr_db = 0;
  double seconds = 0;   // all channels of the scene at this size
  std::string refusal;  // first reason; empty if ok
};

// Renders the rig's shots once and measures their ideal samples with the rig's (exact) scale at
// each size. The rows are ordered by size. A size that the whole scene refuses yields a single row
// with `refusal` set. Throws InputError for a rig without truth.
std::vector<PatchesBenchRow> bench_patches(const std::string& scene, const Rig& rig,
                                           const ObjectScenes& objects,
                                           const PatchesBenchOptions& options);

// Largest errors of a material and channel over the sizes, and the range of the estimates.
struct PatchesBenchSpread {
  std::string scene;
  std::string material;
  char channel = 'R';
  double worst_sigma_s_prime = 0;  // |error|
  double worst_sigma_a = 0;
  double spread_sigma_s_prime = 0;  // largest - smallest estimate, relative to the truth
  double spread_sigma_a = 0;
  bool within = false;  // not refused at any size, worst at most 0.1 % and 1 %
};
std::vector<PatchesBenchSpread> patches_spread(const std::vector<PatchesBenchRow>& rows);

std::string patches_bench_table(const std::vector<PatchesBenchRow>& rows);
std::string patches_bench_csv(const std::vector<PatchesBenchRow>& rows);

}  // namespace scattermeter::apps
