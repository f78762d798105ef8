// bench plan: does the forecast of a rig agree with what measuring its shots states?
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/instrument/open_objects.h"
#include "apps/report/plot.h"
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
  std::string setting;  // what was drawn, in words
  char channel = 'R';
  bool planned = false;              // the forecast is no refusal
  bool measured = false;             // nor is the measurement
  std::vector<std::string> reasons;  // of the one that is refused, where the other is not
  // Standard deviations over the values; NaN where there is none.
  double forecast_sigma_s_prime = 0, stated_sigma_s_prime = 0;
  double forecast_sigma_a = 0, stated_sigma_a = 0;
};

// Forecast over stated deviation, of both coefficients of all rows where both are there.
struct PlanBenchRatios {
  std::size_t n = 0;
  double median = 0, least = 0, most = 0;
};

// A rig made in code by a seed: one or two bodies of one material, one to three LEDs, what is known
// of scale, LEDs, pose marks and eta. Precondition: as set_up_camera()'s.
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
