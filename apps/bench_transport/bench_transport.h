// bench transport: speed of the volumetric Monte Carlo.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/progress.h"

namespace scattermeter::apps {

struct TransportBenchOptions {
  std::uint64_t seed = 1;
  double seconds = 1.0;  // processor time per row, approximately
  Progress* progress = nullptr;
};

// The 20 mm cube or sphere (eta 1.3, g 0, sigma_a 0.002 per mm) under one LED.
struct TransportBenchRow {
  std::string body;
  std::int64_t triangles = 12;
  bool by_rays = false;  // otherwise by the planes of the convex body
  double mean_free_path_mm = 0;
  bool connections = false;  // of every scattering to the camera
  double scatterings_per_path = 0;
  double scatterings_per_s = 0;  // per second of processor time
  double connections_per_s = 0;  // that reach the camera
  double escaped = 0;            // of the light that entered
  double audit_error = 0;        // entered minus accounted light, relative
  std::int64_t lost_paths = 0;
};

// Mean free paths of 0.1 to 7 mm in the cube of 12 triangles, then cubes of 12 to 786432 and
// spheres of 320 to 327680 triangles at 0.46 mm; each with and without connections, on one thread.
std::vector<TransportBenchRow> bench_transport(const TransportBenchOptions& options);

std::string transport_bench_table(const std::vector<TransportBenchRow>& rows);
std::string transport_bench_csv(const std::vector<TransportBenchRow>& rows);

}  // namespace scattermeter::apps
