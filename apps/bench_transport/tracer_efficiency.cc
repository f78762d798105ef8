#include "apps/bench_transport/tracer_efficiency.h"

#include <algorithm>
#include <ctime>

#include <fmt/core.h>

#include "apps/bench_transport/lit_body.h"
#include "apps/report/csv.h"
#include "apps/report/text_table.h"

namespace scattermeter::apps {
namespace {

constexpr double kAbsorption = 0.002;

TracerEfficiencyRow efficiency(const LitBody& body, double sigma_s_prime_per_mm,
                               const TracerEfficiencyOptions& options) {
  const Medium medium{sigma_s_prime_per_mm, kAbsorption, LitBody::kEta};
  TracerEfficiencyRow row;
  row.sigma_s_prime_per_mm = sigma_s_prime_per_mm;
  row.patches = body.n_rows();
  // Twice as many paths as before, until they take as long as asked for.
  for (int blocks = 4; row.seconds < 0.7 * options.seconds; blocks *= 2) {
    const std::clock_t start = std::clock();
    const LitBody::Traced traced = body.traced(medium, options.seed, blocks);
    row.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    row.paths = traced.audit.paths;
    row.scatterings_per_s = static_cast<double>(traced.audit.scatterings) / row.seconds;
    row.connections_per_s = static_cast<double>(traced.audit.connections) / row.seconds;
    const double mean = traced.image.l.mean();
    row.variance_seconds = row.seconds * traced.image.variance.mean() / (mean * mean);
  }
  return row;
}

}  // namespace

std::vector<TracerEfficiencyRow> tracer_efficiency(const TracerEfficiencyOptions& options) {
  std::vector<TracerEfficiencyRow> rows;
  ProgressStage stage(options.progress, "tracing",
                      options.bodies.size() * options.sigma_s_prime_per_mm.size());
  for (const std::string& name : options.bodies) {
    const LitBody body(name, {.image_width_px = options.image_width_px});
    for (const double sigma_s : options.sigma_s_prime_per_mm) {
      rows.push_back(efficiency(body, sigma_s, options));
      rows.back().body = name;
      stage.step();
    }
  }
  return rows;
}

std::string tracer_efficiency_table(const std::vector<TracerEfficiencyRow>& rows) {
  using Align = TextTable::Align;
  TextTable table({{"body", Align::kLeft},
                   {"sigma_s' /mm"},
                   {"patches"},
                   {"paths"},
                   {"scatterings million/s"},
                   {"connections million/s"},
                   {"variance x s"}});
  for (const TracerEfficiencyRow& r : rows) {
    table.add_row({r.body, fmt::format("{:.2f}", r.sigma_s_prime_per_mm), std::to_string(r.patches),
                   std::to_string(r.paths), fmt::format("{:.2f}", 1e-6 * r.scatterings_per_s),
                   fmt::format("{:.2f}", 1e-6 * r.connections_per_s),
                   fmt::format("{:.3g}", r.variance_seconds)});
  }
  return table.text();
}

std::string tracer_efficiency_csv(const std::vector<TracerEfficiencyRow>& rows) {
  Csv csv({"body", "sigma_s_prime_per_mm", "patches", "paths", "cpu_seconds", "scatterings_per_s",
           "connections_per_s", "variance_seconds"});
  for (const TracerEfficiencyRow& r : rows) {
    csv.add_row({r.body, csv_number(r.sigma_s_prime_per_mm), std::to_string(r.patches),
                 std::to_string(r.paths), csv_number(r.seconds), csv_number(r.scatterings_per_s),
                 csv_number(r.connections_per_s), csv_number(r.variance_seconds)});
  }
  return csv.text();
}

}  // namespace scattermeter::apps
