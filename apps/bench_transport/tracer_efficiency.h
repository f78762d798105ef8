// bench atlas: variance times time of the tracer of paths.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/progress.h"

namespace scattermeter::apps {

struct TracerEfficiencyOptions {
  std::vector<std::string> bodies = {"cube", "sphere", "scan"};  // names of core/mesh/bodies.h
  std::vector<double> sigma_s_prime_per_mm = {2.19, 0.5};
  double seconds = 2;  // of processor time, about, of a row
  int image_width_px = 968;
  std::uint64_t seed = 1;
  Progress* progress = nullptr;
};

struct TracerEfficiencyRow {
  std::string body;
  double sigma_s_prime_per_mm = 0;  // sigma_a is 0.002 per mm
  std::int64_t patches = 0;         // of 1 mm
  std::int64_t paths = 0;
  double seconds = 0;  // of processor time, over all threads
  double scatterings_per_s = 0;
  double connections_per_s = 0;  // that reach the camera
  // Mean variance of a patch's light, relative to the square of the mean light, times seconds of
  // processor time: half of it is twice the work for the same time.
  double variance_seconds = 0;
};

std::vector<TracerEfficiencyRow> tracer_efficiency(const TracerEfficiencyOptions& options);

std::string tracer_efficiency_table(const std::vector<TracerEfficiencyRow>& rows);
std::string tracer_efficiency_csv(const std::vector<TracerEfficiencyRow>& rows);

}  // namespace scattermeter::apps
