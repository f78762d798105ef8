#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

#include <fmt/core.h>

#include "apps/bench/bench_sums.h"
#include "apps/report/csv.h"
#include "apps/report/text_table.h"

namespace scattermeter::apps {
namespace {

double all_seconds(const SumsBenchRow& r) { return r.tree_one_s + r.sum_one_s; }

double worst_of(const SumsBenchRow& r) {
  return *std::max_element(std::begin(r.worst_error), std::end(r.worst_error));
}

// For each scene of one channel, the fastest run with measured errors, of value and derivatives, of
// at most 1e-4.
std::string fastest_within(const SumsBench& bench) {
  constexpr double kError = 1e-4;
  std::map<std::tuple<std::string, double, double>, const SumsBenchRow*> fastest;
  for (const SumsBenchRow& r : bench.rows) {
    if (r.channels > 1 || worst_of(r) > kError) continue;
    const SumsBenchRow*& best = fastest[{r.body, r.patches, r.rows}];
    if (best == nullptr || r.tree_s + r.sum_s < best->tree_s + best->sum_s) best = &r;
  }
  std::string text;
  for (const auto& [scene, r] : fastest) {
    const double direct_s = 1e-9 * r->direct_ns * r->patches * r->rows;
    text += fmt::format(
        "{}, {:.0f} patches, {:.0f} rows: errors of at most {:.0e} measured at tolerance {:.0e}, "
        "{:.0f} times faster than the direct sum's {:.3f} s on one thread; all threads {:.0f} "
        "times, with the tree at hand {:.0f} times\n",
        r->body, r->patches, r->rows, kError, r->tolerance, r->speedup, direct_s,
        direct_s / (r->tree_s + r->sum_s), direct_s / r->sum_s);
  }
  return text.empty() ? text : "\n" + text;
}

// Adds a point to the series of this name, which is created if necessary.
void add_point(const std::string& name, double x, double y, Plot& plot) {
  auto series = std::find_if(plot.series.begin(), plot.series.end(),
                             [&](const PlotSeries& s) { return s.name == name; });
  if (series == plot.series.end()) {
    series = plot.series.insert(series, {name, PlotSeries::Style::kLineAndPoints, {}, {}});
  }
  series->x.push_back(x);
  series->y.push_back(y);
}

}  // namespace

std::string sums_bench_table(const SumsBench& bench) {
  using Align = TextTable::Align;
  TextTable table({{"body", Align::kLeft},
                   {"ch"},
                   {"patches"},
                   {"rows"},
                   {"tolerance"},
                   {"tree s"},
                   {"sum s"},
                   {"1 thread s"},
                   {"direct ns/pair"},
                   {"times faster"},
                   {"median error"},
                   {"worst error"},
                   {"by sigma_s'"},
                   {"by sigma_a"},
                   {"certified"},
                   {"pairs/row"},
                   {"series/row"}});
  for (const SumsBenchRow& r : bench.rows) {
    table.add_row({r.body, std::to_string(r.channels), fmt::format("{:.0f}", r.patches),
                   fmt::format("{:.0f}", r.rows), fmt::format("{:.0e}", r.tolerance),
                   fmt::format("{:.4f}", r.tree_s), fmt::format("{:.4f}", r.sum_s),
                   fmt::format("{:.4f}", all_seconds(r)), fmt::format("{:.2f}", r.direct_ns),
                   fmt::format("{:.1f}", r.speedup), fmt::format("{:.1e}", r.median_error),
                   fmt::format("{:.1e}", r.worst_error[0]), fmt::format("{:.1e}", r.worst_error[1]),
                   fmt::format("{:.1e}", r.worst_error[2]),
                   fmt::format("{:.1e}", r.certified_error), fmt::format("{:.0f}", r.pairs_per_row),
                   fmt::format("{:.0f}", r.series_per_row)});
  }
  std::string text = table.text();
  std::set<std::string> lines;
  for (const SumsBenchRow& r : bench.rows) {
    const double exponent = patches_exponent(bench, r.body, r.rows, r.tolerance);
    if (!std::isfinite(exponent)) continue;
    const std::string line =
        fmt::format("time grows with patches^{:.2f} ({}, {:.0f} rows, tolerance {:.0e})\n",
                    exponent, r.body, r.rows, r.tolerance);
    if (lines.insert(line).second) text += (lines.size() == 1 ? "\n" : "") + line;
  }
  text += fastest_within(bench);
  if (bench.peers.empty()) return text;
  TextTable peers({{"fit of two coefficients", Align::kLeft},
                   {"s"},
                   {"times ours"},
                   {"sigma_s' error %"},
                   {"sigma_a error %"}});
  for (const PeerResult& p : bench.peers) {
    peers.add_row({p.method, fmt::format("{:.3f}", p.seconds),
                   fmt::format("{:.1f}", p.seconds / bench.peers.front().seconds),
                   fmt::format("{:+.4f}", 100.0 * p.error_sigma_s_prime),
                   fmt::format("{:+.4f}", 100.0 * p.error_sigma_a)});
  }
  return text + "\n" + peers.text();
}

std::string sums_bench_csv(const SumsBench& bench) {
  Csv csv({"body", "channels", "patches", "rows", "tolerance", "tree_s", "sum_s", "tree_one_s",
           "sum_one_s", "direct_ns_per_pair", "times_faster", "median_error", "worst_error",
           "worst_error_d_sigma_s_prime", "worst_error_d_sigma_a", "certified_error",
           "pairs_per_row", "series_per_row"});
  for (const SumsBenchRow& r : bench.rows) {
    csv.add_row({r.body, std::to_string(r.channels), csv_number(r.patches), csv_number(r.rows),
                 csv_number(r.tolerance), csv_number(r.tree_s), csv_number(r.sum_s),
                 csv_number(r.tree_one_s), csv_number(r.sum_one_s), csv_number(r.direct_ns),
                 csv_number(r.speedup), csv_number(r.median_error), csv_number(r.worst_error[0]),
                 csv_number(r.worst_error[1]), csv_number(r.worst_error[2]),
                 csv_number(r.certified_error), csv_number(r.pairs_per_row),
                 csv_number(r.series_per_row)});
  }
  return csv.text();
}

std::string sums_peer_csv(const SumsBench& bench) {
  Csv csv({"method", "seconds", "sigma_s_prime_error", "sigma_a_error"});
  for (const PeerResult& p : bench.peers) {
    csv.add_row({p.method, csv_number(p.seconds), csv_number(p.error_sigma_s_prime),
                 csv_number(p.error_sigma_a)});
  }
  return csv.text();
}

Plot sums_error_plot(const SumsBench& bench) {
  Plot plot;
  plot.title = "Sums over clusters: error over run time";
  plot.x = {"time of a row and channel (us, one thread)", true};
  plot.y = {"largest relative error of the value", true};
  plot.legend_outside = true;
  for (const SumsBenchRow& r : bench.rows) {
    const std::string name = fmt::format("{}, {:.0f} patches, {:.0f} rows, {} channel{}", r.body,
                                         r.patches, r.rows, r.channels, r.channels > 1 ? "s" : "");
    add_point(name, 1e6 * all_seconds(r) / r.rows / r.channels, r.worst_error[0], plot);
  }
  return plot;
}

Plot sums_patches_plot(const SumsBench& bench) {
  Plot plot;
  plot.title = "Sums over clusters: run time over patches";
  plot.x = {"patches", true};
  plot.y = {"time (s, one thread)", true};
  plot.legend_outside = true;
  for (const SumsBenchRow& r : bench.rows) {
    if (r.channels > 1) continue;
    const std::string name =
        fmt::format("{}, {:.0f} rows, tolerance {:.0e}", r.body, r.rows, r.tolerance);
    add_point(name, r.patches, all_seconds(r), plot);
  }
  return plot;
}

}  // namespace scattermeter::apps
