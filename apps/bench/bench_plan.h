// bench plan: comparison of the forecast for a rig with what measuring its shots states.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/report/plot.h"
#include "apps/rig/open_objects.h"
#include "apps/rig/rig.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

struct PlanBenchOptions {
  int rigs = 20;  // >= 1
  std::uint64_t seed = 1;
  int image_width_px = 484;
  Progress* progress = nullptr;
};

// A material in a channel of one rig.
struct PlanBenchRow {
  int rig = 0;
  std::string setting;  // the draw in words
  char channel = 'R';
  bool planned = false;              // the forecast is not a refusal
  bool measured = false;             // nor is the result
  std::vector<std::string> reasons;  // of the refused one, if the other is not
  // Relative standard deviations; NaN if refused.
  double forecast_sigma_s_prime = 0, stated_sigma_s_prime = 0;
  double forecast_sigma_a = 0, stated_sigma_a = 0;
};

// Ratios of forecast to stated standard deviation, of both coefficients in all rows that have both.
struct PlanBenchRatios {
  std::size_t n = 0;
  double median = 0, least = 0, most = 0;
};

// A random rig: one or two bodies of one material, one to three LEDs, uncertainties of scale, LEDs,
// pose marks and eta. Throws std::invalid_argument as set_up_camera() does.
struct DrawnPlanRig {
  Rig rig;
  std::string setting;
};
DrawnPlanRig draw_plan_rig(std::uint64_t seed, int image_width_px);

// Plans each rig, exposes its shots with noise, and measures them with the dipole.
std::vector<PlanBenchRow> bench_plan(const PlanBenchOptions& options);
// One rig.
std::vector<PlanBenchRow> plan_and_measure(const Rig& rig, const ObjectScenes& objects,
                                           std::uint64_t seed);

PlanBenchRatios plan_bench_ratios(const std::vector<PlanBenchRow>& rows);
std::string plan_bench_table(const std::vector<PlanBenchRow>& rows);
std::string plan_bench_csv(const std::vector<PlanBenchRow>& rows);
// Stated against forecast.
Plot plan_bench_plot(const std::vector<PlanBenchRow>& rows);

}  // namespace scattermeter::apps
