#include "apps/bench_transport/bench_transport.h"

#include <cmath>
#include <ctime>
#include <utility>

#include <fmt/core.h>

#include "apps/report/csv.h"
#include "apps/report/text_table.h"
#include "core/base/progress.h"
#include "core/mesh/bodies.h"
#include "core/mesh/round_bodies.h"
#include "core/transport/path_tracer.h"

namespace scattermeter::apps {
namespace {

constexpr double kEta = 1.3;
constexpr double kSigmaA = 0.002;

// The least that a user of the scores does.
struct Sum {
  double weight = 0;
  void escape(const PathScore& s) { weight += s.weight; }
  void camera(const PathScore& s) { weight += s.weight; }
};

struct Body {
  std::string name;
  RayScene scene;
  PathBoundary boundary;
  Body(std::string called, const TriangleMesh& mesh, PathBoundary::Method method)
      : name(std::move(called)), scene(mesh), boundary(scene, method) {}
};

TransportBenchRow measure(const Body& body, double mean_free_path_mm, bool connections,
                          const TransportBenchOptions& options) {
  const ScatteringMedium medium{1.0 / mean_free_path_mm - kSigmaA, kSigmaA, 0.0, kEta};
  Led led;
  led.position_mm = {30, -60, 80};
  led.axis = (Eigen::Vector3d(0, 0, 10) - led.position_mm).normalized();
  const auto source = led_entry(body.scene, led, kEta);
  const CameraConnection camera(body.boundary, {0, -100, 150}, medium);
  PathOptions path_options;
  path_options.seed = options.seed;
  path_options.paths_per_block = 256;
  Sum sum;
  PathTracer<Sum> tracer({body.boundary, medium, *source, connections ? &camera : nullptr},
                         path_options, sum);
  PathAudit audit;
  const std::clock_t start = std::clock();
  double seconds = 0.0;
  for (std::uint64_t block = 0; seconds < options.seconds; ++block) {
    audit += tracer.trace_block(block);
    seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  TransportBenchRow row;
  row.body = body.name;
  row.triangles = static_cast<std::int64_t>(body.scene.mesh().triangles.size());
  row.by_rays = !body.boundary.by_planes();
  row.mean_free_path_mm = mean_free_path_mm;
  row.connections = connections;
  row.scatterings_per_path =
      static_cast<double>(audit.scatterings) / static_cast<double>(audit.paths);
  row.scatterings_per_s = static_cast<double>(audit.scatterings) / seconds;
  row.connections_per_s = static_cast<double>(audit.connections) / seconds;
  row.escaped = audit.escaped / audit.entered;
  row.audit_error = (audit.entered - audit.absorbed - audit.escaped - audit.roulette - audit.lost) /
                    audit.entered;
  row.lost_paths = audit.lost_paths;
  return row;
}

}  // namespace

std::vector<TransportBenchRow> bench_transport(const TransportBenchOptions& options) {
  const std::vector<double> mean_free_paths_mm = {1.0 / 2.192, 0.1, 0.2, 1.0, 2.0, 7.0};
  const std::vector<int> levels = {0, 2, 4, 6, 8};
  const std::vector<int> sphere_levels = {2, 4, 5, 7};
  std::vector<TransportBenchRow> rows;
  ProgressStage stage(options.progress, "tracing",
                      mean_free_paths_mm.size() + levels.size() + sphere_levels.size());
  const auto both = [&](const Body& body, double mm) {
    for (bool connections : {false, true}) rows.push_back(measure(body, mm, connections, options));
    stage.step();
  };
  const Body cube("cube", cube_mesh(), PathBoundary::Method::kAuto);
  for (double mm : mean_free_paths_mm) both(cube, mm);
  for (int level : levels) {
    both({"cube", cut_finer(cube_mesh(), level), PathBoundary::Method::kRays},
         mean_free_paths_mm.front());
  }
  for (int level : sphere_levels) {
    both({"sphere", sphere_mesh(level), PathBoundary::Method::kAuto}, mean_free_paths_mm.front());
  }
  return rows;
}

std::string transport_bench_table(const std::vector<TransportBenchRow>& rows) {
  using Align = TextTable::Align;
  TextTable table({{"body", Align::kLeft},
                   {"triangles"},
                   {"by", Align::kLeft},
                   {"mean free path mm"},
                   {"connections", Align::kLeft},
                   {"scatterings/path"},
                   {"million/s and core"},
                   {"connections million/s"},
                   {"escaped %"},
                   {"audit error"},
                   {"lost"}});
  for (const TransportBenchRow& r : rows) {
    table.add_row({r.body, std::to_string(r.triangles), r.by_rays ? "rays" : "planes",
                   fmt::format("{:.3f}", r.mean_free_path_mm), r.connections ? "on" : "off",
                   fmt::format("{:.1f}", r.scatterings_per_path),
                   fmt::format("{:.1f}", 1e-6 * r.scatterings_per_s),
                   fmt::format("{:.2f}", 1e-6 * r.connections_per_s),
                   fmt::format("{:.2f}", 100.0 * r.escaped), fmt::format("{:.0e}", r.audit_error),
                   std::to_string(r.lost_paths)});
  }
  return table.text();
}

std::string transport_bench_csv(const std::vector<TransportBenchRow>& rows) {
  Csv csv({"body", "triangles", "by", "mean_free_path_mm", "connections", "scatterings_per_path",
           "scatterings_per_s_and_core", "connections_per_s_and_core", "escaped", "audit_error",
           "lost_paths"});
  for (const TransportBenchRow& r : rows) {
    csv.add_row({r.body, std::to_string(r.triangles), r.by_rays ? "rays" : "planes",
                 csv_number(r.mean_free_path_mm), r.connections ? "on" : "off",
                 csv_number(r.scatterings_per_path), csv_number(r.scatterings_per_s),
                 csv_number(r.connections_per_s), csv_number(r.escaped), csv_number(r.audit_error),
                 std::to_string(r.lost_paths)});
  }
  return csv.text();
}

}  // namespace scattermeter::apps
