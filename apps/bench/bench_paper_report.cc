// Table, CSV and plots of bench paper.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "apps/bench/bench_paper.h"
#include "apps/report/csv.h"
#include "apps/report/text_table.h"
#include "core/material/dipole.h"

namespace scattermeter::apps {
namespace {

using Style = PlotSeries::Style;

constexpr double kTruthEta = 1.3;
constexpr double kNearest_mm = 0.03;  // position of d = 0 on a logarithmic axis

const PaperEstimate& best_of_paper(const PaperBench& bench) {
  return std::max_element(bench.widths.begin(), bench.widths.end(),
                          [](const PaperBenchRow& a, const PaperBenchRow& b) {
                            return a.paper.psnr_db < b.paper.psnr_db;
                          })
      ->paper;
}

template <class Y>
PlotSeries over_widths(const PaperBench& bench, const std::string& name, const Y& y) {
  PlotSeries series{name, Style::kLineAndPoints, {}, {}, {}};
  for (const PaperBenchRow& row : bench.widths) {
    series.x.push_back(row.published.width_mm);
    series.y.push_back(y(row));
  }
  return series;
}

PlotSeries level(const std::string& name, double y) {
  return {name, Style::kLine, {0.0, 0.55}, {y, y}, {}};
}

PlotSeries dipole_series(const std::string& name, double sigma_s, double sigma_a) {
  const Dipole dipole({sigma_s, sigma_a, kTruthEta});
  PlotSeries series{name, Style::kLine, {}, {}, {}};
  for (double d = kNearest_mm; d < 30.0; d *= 1.03) {
    series.x.push_back(d);
    series.y.push_back(dipole.reflectance_per_mm2(d));
  }
  return series;
}

std::string spread_text(const WidthSpread& s) {
  return fmt::format("{:.3g} % / {:.3g} %", 100.0 * s.sigma_s, 100.0 * s.sigma_a);
}

}  // namespace

std::string paper_bench_table(const PaperBench& bench) {
  TextTable table({{"width mm"},
                   {"published: sigma_s"},
                   {"sigma_a"},
                   {"PSNR dB"},
                   {"its method here: sigma_s"},
                   {"sigma_a"},
                   {"PSNR dB"},
                   {"ours: sigma_s'"},
                   {"sigma_a"},
                   {"PSNR dB"}});
  const auto quantity = [](const Quantity& q, int digits) {
    return fmt::format("{:.{}f} ± {:.{}f}", q.value, digits, q.std, digits);
  };
  for (const PaperBenchRow& row : bench.widths) {
    table.add_row({fmt::format("{:.2f}", row.published.width_mm),
                   fmt::format("{:.2f}", row.published.sigma_s_per_mm),
                   fmt::format("{:.3f}", row.published.sigma_a_per_mm),
                   fmt::format("{:.2f}", row.published.psnr_db),
                   fmt::format("{:.2f}", row.paper.sigma_s_prime_per_mm),
                   fmt::format("{:.3f}", row.paper.sigma_a_per_mm),
                   fmt::format("{:.2f}", row.paper.psnr_db),
                   quantity(row.ours.sigma_s_prime_per_mm, 4), quantity(row.ours.sigma_a_per_mm, 6),
                   fmt::format("{:.2f}", row.ours_psnr_db)});
  }
  table.add_row({"none", "", "", "", "", "", "", quantity(bench.dipole.sigma_s_prime_per_mm, 4),
                 quantity(bench.dipole.sigma_a_per_mm, 6),
                 fmt::format("{:.2f}", bench.dipole.psnr_db)});
  table.add_row({"truth", fmt::format("{:.2f}", bench.truth.sigma_s_prime_per_mm),
                 fmt::format("{:.3f}", bench.truth.sigma_a_per_mm), "", "", "", "", "", "", ""});
  std::string text = table.text();
  text += fmt::format(
      "largest - smallest over the widths, relative to the truth, sigma_s' / sigma_a: published "
      "{}, "
      "its method here {}, ours {}\n",
      spread_text(published_spread(bench)), spread_text(paper_spread(bench)),
      spread_text(our_spread(bench)));
  text += fmt::format("{} patches of {:.3g} mm; 1/mm throughout\n", bench.rows, bench.patch_mm);
  for (const std::string& reason : bench.dipole.reasons) text += "refused: " + reason + "\n";
  for (const PaperBenchRow& row : bench.widths) {
    for (const std::string& reason : row.ours.reasons) {
      text += fmt::format("{:.2f} mm refused: {}\n", row.published.width_mm, reason);
    }
  }
  return text;
}

std::string paper_bench_csv(const PaperBench& bench) {
  Csv csv({"width_mm", "published_sigma_s_per_mm", "published_sigma_a_per_mm", "published_psnr_db",
           "paper_sigma_s_per_mm", "paper_sigma_a_per_mm", "paper_psnr_db",
           "ours_sigma_s_prime_per_mm", "ours_sigma_s_prime_std_per_mm", "ours_sigma_a_per_mm",
           "ours_sigma_a_std_per_mm", "ours_psnr_db", "ours_verdict"});
  const auto verdict = [](const Estimate& e) { return e.reasons.empty() ? "ok" : "refused"; };
  for (const PaperBenchRow& r : bench.widths) {
    csv.add_row({csv_number(r.published.width_mm), csv_number(r.published.sigma_s_per_mm),
                 csv_number(r.published.sigma_a_per_mm), csv_number(r.published.psnr_db),
                 csv_number(r.paper.sigma_s_prime_per_mm), csv_number(r.paper.sigma_a_per_mm),
                 csv_number(r.paper.psnr_db), csv_number(r.ours.sigma_s_prime_per_mm.value),
                 csv_number(r.ours.sigma_s_prime_per_mm.std),
                 csv_number(r.ours.sigma_a_per_mm.value), csv_number(r.ours.sigma_a_per_mm.std),
                 csv_number(r.ours_psnr_db), verdict(r.ours)});
  }
  const Estimate& d = bench.dipole;
  csv.add_row({"none", "", "", "", "", "", "", csv_number(d.sigma_s_prime_per_mm.value),
               csv_number(d.sigma_s_prime_per_mm.std), csv_number(d.sigma_a_per_mm.value),
               csv_number(d.sigma_a_per_mm.std), csv_number(d.psnr_db), verdict(d)});
  return csv.text();
}

std::string paper_reflectance_csv(const PaperBench& bench) {
  Csv csv({"curve", "distance_mm", "r_per_mm2", "log_std", "determined", "truth_per_mm2"});
  const Dipole truth({bench.truth.sigma_s_prime_per_mm, bench.truth.sigma_a_per_mm, kTruthEta});
  const PaperEstimate& paper = best_of_paper(bench);
  for (Eigen::Index i = 0; i < paper.r.size(); ++i) {
    const double d = static_cast<double>(i) * paper.width_mm;
    csv.add_row({"paper", csv_number(d), csv_number(paper.r[i]), "", "",
                 csv_number(truth.reflectance_per_mm2(d))});
  }
  for (const ReflectanceKnot& k : bench.smooth.knots) {
    csv.add_row({"smooth", csv_number(k.distance_mm), csv_number(k.r_per_mm2),
                 csv_number(k.log_std), k.determined ? "1" : "0",
                 csv_number(truth.reflectance_per_mm2(k.distance_mm))});
  }
  return csv.text();
}

Plot paper_psnr_plot(const PaperBench& bench) {
  Plot plot;
  plot.title = "PSNR of the re-rendered image over the quantisation width (the paper's figure 5)";
  plot.x = {"quantisation width [mm]", false, 0.0, 0.55};
  plot.y = {"PSNR [dB]", false, 0.0, 100.0};
  plot.series = {
      over_widths(bench, "published", [](const PaperBenchRow& r) { return r.published.psnr_db; }),
      over_widths(bench, "the paper's method, this image",
                  [](const PaperBenchRow& r) { return r.paper.psnr_db; }),
      over_widths(bench, "dipole fitted to r in its own metric",
                  [](const PaperBenchRow& r) { return r.ours_psnr_db; })};
  return plot;
}

Plot paper_reflectance_plot(const PaperBench& bench) {
  const PaperEstimate& paper = best_of_paper(bench);
  PlotSeries raw{"", Style::kPoints, {}, {}, {}};
  int hidden = 0;
  for (Eigen::Index i = 1; i < paper.r.size(); ++i) {
    raw.x.push_back(static_cast<double>(i) * paper.width_mm);
    raw.y.push_back(paper.r[i]);
    hidden += paper.r[i] > 0.0 ? 0 : 1;
  }
  raw.name = fmt::format("pseudo-inverse, {:.2f} mm ({} values of 0 or less not shown)",
                         paper.width_mm, hidden);
  PlotSeries smooth{"recovered without a model, 95 % bars", Style::kPoints, {}, {}, {}};
  for (const ReflectanceKnot& k : bench.smooth.knots) {
    if (!k.determined) continue;
    smooth.x.push_back(std::max(k.distance_mm, kNearest_mm));
    smooth.y.push_back(k.r_per_mm2);
    smooth.y_std.push_back(1.96 * k.log_std * k.r_per_mm2);
  }
  Plot plot;
  plot.title =
      "Recovered reflectance and the true dipole (the paper's figure 6; d = 0 is drawn at 0.03 mm)";
  plot.x = {"distance [mm]", true, 0.025, 30.0};
  plot.y = {"r [1/mm^2]", true, 1e-7, 10.0};
  plot.series = {
      raw, dipole_series("truth", bench.truth.sigma_s_prime_per_mm, bench.truth.sigma_a_per_mm),
      dipole_series(fmt::format("the paper's estimate, {:.2f} / {:.3f}", paper.sigma_s_prime_per_mm,
                                paper.sigma_a_per_mm),
                    paper.sigma_s_prime_per_mm, paper.sigma_a_per_mm),
      smooth};
  return plot;
}

Plot paper_reflectance_ratio_plot(const PaperBench& bench) {
  const Dipole truth({bench.truth.sigma_s_prime_per_mm, bench.truth.sigma_a_per_mm, kTruthEta});
  const PaperEstimate& paper = best_of_paper(bench);
  PlotSeries raw{fmt::format("pseudo-inverse, {:.2f} mm", paper.width_mm), Style::kPoints, {}, {}};
  for (Eigen::Index i = 0; i < paper.r.size(); ++i) {
    const double d = static_cast<double>(i) * paper.width_mm;
    raw.x.push_back(std::max(d, kNearest_mm));
    raw.y.push_back(paper.r[i] / truth.reflectance_per_mm2(d));
  }
  PlotSeries smooth{"recovered without a model, 95 % bars", Style::kPoints, {}, {}, {}};
  for (const ReflectanceKnot& k : bench.smooth.knots) {
    if (!k.determined) continue;
    const double ratio = k.r_per_mm2 / truth.reflectance_per_mm2(k.distance_mm);
    smooth.x.push_back(std::max(k.distance_mm, kNearest_mm));
    smooth.y.push_back(ratio);
    smooth.y_std.push_back(1.96 * k.log_std * ratio);
  }
  Plot plot;
  plot.title = "Recovered reflectance over the true dipole (d = 0 is drawn at 0.03 mm)";
  plot.x = {"distance [mm]", true, 0.025, 30.0};
  plot.y = {"r / R", false, 0.5, 1.5};
  plot.series = {raw, {"truth", Style::kLine, {0.025, 30.0}, {1.0, 1.0}, {}}, smooth};
  return plot;
}

Plot paper_absorption_plot(const PaperBench& bench) {
  Plot plot;
  plot.title = "sigma_a over the quantisation width";
  plot.x = {"quantisation width [mm]", false, 0.0, 0.55};
  plot.y = {"sigma_a [1/mm]", false, 0.0, 0.0125};
  PlotSeries ours = over_widths(bench, "dipole fitted to r in its own metric",
                                [](const PaperBenchRow& r) { return r.ours.sigma_a_per_mm.value; });
  for (const PaperBenchRow& r : bench.widths) ours.y_std.push_back(r.ours.sigma_a_per_mm.std);
  plot.series = {over_widths(bench, "published",
                             [](const PaperBenchRow& r) { return r.published.sigma_a_per_mm; }),
                 over_widths(bench, "the paper's method, this image",
                             [](const PaperBenchRow& r) { return r.paper.sigma_a_per_mm; }),
                 ours, level("truth", bench.truth.sigma_a_per_mm)};
  return plot;
}

}  // namespace scattermeter::apps
