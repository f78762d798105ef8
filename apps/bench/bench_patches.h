// bench patches: what the patch size does to the answer where nothing else is wrong.
#pragma once

#include <string>
#include <vector>

#include "apps/instrument/open_objects.h"
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
  std::size_t rows = 0;            // patches times shots that took part
  double samples_per_patch = 0;    // of this channel, mean over the patches that took part
  double error_sigma_s_prime = 0;  // answer / truth - 1; NaN where there is no answer at all
  double error_sigma_a = 0;
  double std_sigma_s_prime = 0;  // stated, relative to the truth
  double std_sigma_a = 0;
  double psnr_db = 0;
  double seconds = 0;   // all channels of the scene at this size
  std::string refusal;  // first reason; "" for ok
};

// Renders the rig's shots once and measures them, ideal samples and the rig's own (exact) scale, at
// each size. Sizes outermost. A size that the scene refuses as a whole gives no rows but one with
// `refusal` set. Throws InputError for a rig without truth.
std::vector<PatchesBenchRow> bench_patches(const std::string& scene, const Rig& rig,
                                           const ObjectScenes& objects,
                                           const PatchesBenchOptions& options);

// Largest errors of a material and channel over the sizes, and the range of its answers.
struct PatchesBenchSpread {
  std::string scene;
  std::string material;
  char channel = 'R';
  double worst_sigma_s_prime = 0;  // |error|
  double worst_sigma_a = 0;
  double spread_sigma_s_prime = 0;  // largest - smallest answer, relative to the truth
  double spread_sigma_a = 0;
  bool within = false;  // every size answered, worst at most 0.1 % and 1 %
};
std::vector<PatchesBenchSpread> patches_spread(const std::vector<PatchesBenchRow>& rows);

std::string patches_bench_table(const std::vector<PatchesBenchRow>& rows);
std::string patches_bench_csv(const std::vector<PatchesBenchRow>& rows);

}  // namespace scattermeter::apps
