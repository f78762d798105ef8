#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "apps/bench/bench_models.h"
#include "apps/report/csv.h"
#include "apps/report/text_table.h"
#include "core/mesh/bodies.h"

namespace scattermeter::apps {
namespace {

const std::vector<std::string>& model_names() {
  static const std::vector<std::string> names = {"paper", "dipole", "transport"};
  return names;
}

const char* status_name(ModelsBenchStatus status) {
  switch (status) {
    case ModelsBenchStatus::kAnswered:
      return "ok";
    case ModelsBenchStatus::kRefused:
      return "refused";
    case ModelsBenchStatus::kFailed:
      return "failed";
    case ModelsBenchStatus::kLeftOut:
      return "left out";
  }
  throw std::invalid_argument("status_name: no such status");
}

// A dash if a number is missing.
template <class... Numbers>
std::string cell(const char* format, Numbers... numbers) {
  if (!(std::isfinite(numbers) && ...)) return "-";
  return fmt::format(fmt::runtime(format), numbers...);
}

std::string case_name(const ModelsBenchRow& r) {
  return fmt::format("{} {}", r.material.name, r.material.channel);
}

std::string status_text(const ModelsBenchRow& r) {
  return fmt::format("{}{}{}", status_name(r.status), r.reason.empty() ? "" : ": ", r.reason);
}

// NaN for no values.
double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

std::string rows_text(const std::vector<ModelsBenchRow>& rows) {
  using Align = TextTable::Align;
  TextTable table({{"body", Align::kLeft},
                   {"material", Align::kLeft},
                   {"model", Align::kLeft},
                   {"sigma_s' error %"},
                   {"truth ±"},
                   {"z"},
                   {"sigma_a error %"},
                   {"truth ±"},
                   {"error 1/mm"},
                   {"z"},
                   {"Monte Carlo %"},
                   {"s"},
                   {"CPU s"},
                   {"status", Align::kLeft}});
  double least = INFINITY, most = 0.0;
  for (const ModelsBenchRow& r : rows) {
    if (r.status == ModelsBenchStatus::kLeftOut) continue;
    if (std::isfinite(r.truth_patch_std)) {
      least = std::min(least, r.truth_patch_std);
      most = std::max(most, r.truth_patch_std);
    }
    const double s = r.material.medium.sigma_s_prime_per_mm;
    const double a = r.material.medium.sigma_a_per_mm;
    table.add_row(
        {r.body, case_name(r), r.model.empty() ? "all" : r.model,
         cell("{:+.2f} ± {:.2f}", 100.0 * r.error_sigma_s_prime,
              100.0 * r.sigma_s_prime_per_mm.std / s),
         cell("{:.2f}", 100.0 * r.truth_std_sigma_s_prime_per_mm / s),
         cell("{:+.1f}", r.z_sigma_s_prime),
         cell("{:+.2f} ± {:.2f}", 100.0 * r.error_sigma_a, 100.0 * r.sigma_a_per_mm.std / a),
         cell("{:.2f}", 100.0 * r.truth_std_sigma_a_per_mm / a),
         cell("{:+.6f}", a * r.error_sigma_a), cell("{:+.1f}", r.z_sigma_a),
         cell("{:.1f}", 100.0 * r.monte_carlo_share), cell("{:.1f}", r.seconds),
         cell("{:.1f}", r.cpu_seconds), status_text(r)});
  }
  const std::string noise =
      most == 0.0
          ? ""
          : fmt::format(
                "Monte Carlo error of a patch's light in the shots, median: {:.1f} to {:.1f} %\n",
                100.0 * least, 100.0 * most);
  return table.text() + noise +
         "error: estimate / truth - 1, ± as stated by the model; truth ±: effect of the Monte "
         "Carlo "
         "error of the shots on the estimate; z: error over both; Monte Carlo: its share of the "
         "stated variance\n";
}

// Estimates of one model on one body; the lists include refused ones.
struct Summary {
  std::size_t answered = 0, refused = 0, failed = 0;
  std::vector<double> s, a, abs_s, abs_a, seconds;
};

std::string summary_text(const std::vector<ModelsBenchRow>& rows) {
  std::map<std::pair<std::string, std::string>, Summary> sums;
  for (const ModelsBenchRow& r : rows) {
    if (r.status == ModelsBenchStatus::kLeftOut || r.model.empty()) continue;
    Summary& sum = sums[{r.body, r.model}];
    sum.refused += r.status == ModelsBenchStatus::kRefused ? 1 : 0;
    sum.failed += r.status == ModelsBenchStatus::kFailed ? 1 : 0;
    sum.answered += r.status == ModelsBenchStatus::kAnswered ? 1 : 0;
    if (!std::isfinite(r.error_sigma_s_prime)) continue;
    sum.s.push_back(r.error_sigma_s_prime);
    sum.a.push_back(r.error_sigma_a);
    sum.abs_s.push_back(std::abs(r.error_sigma_s_prime));
    sum.abs_a.push_back(std::abs(r.error_sigma_a));
    sum.seconds.push_back(r.seconds);
  }
  if (sums.empty()) return "";
  using Align = TextTable::Align;
  TextTable table({{"body", Align::kLeft},
                   {"model", Align::kLeft},
                   {"ok"},
                   {"refused"},
                   {"failed"},
                   {"sigma_s' bias %"},
                   {"worst %"},
                   {"sigma_a bias %"},
                   {"worst %"},
                   {"s"}});
  for (const std::string& body : body_names()) {
    for (const std::string& model : model_names()) {
      const auto it = sums.find({body, model});
      if (it == sums.end()) continue;
      const Summary& sum = it->second;
      const auto worst = [](const std::vector<double>& v) {
        return v.empty() ? std::nan("") : *std::max_element(v.begin(), v.end());
      };
      table.add_row(
          {body, model, std::to_string(sum.answered), std::to_string(sum.refused),
           std::to_string(sum.failed), cell("{:+.2f}", 100.0 * median(sum.s)),
           cell("{:.2f}", 100.0 * worst(sum.abs_s)), cell("{:+.2f}", 100.0 * median(sum.a)),
           cell("{:.2f}", 100.0 * worst(sum.abs_a)), cell("{:.1f}", median(sum.seconds))});
    }
  }
  return fmt::format("\n{}", table.text()) +
         "bias and s: medians over the estimates, including refused ones\n";
}

std::string left_out_text(const std::vector<ModelsBenchRow>& rows) {
  std::string list;
  std::size_t n = 0;
  for (const ModelsBenchRow& r : rows) {
    if (r.status != ModelsBenchStatus::kLeftOut) continue;
    ++n;
    list += fmt::format("  {}, {}: {}\n", r.body, case_name(r), r.reason);
  }
  return fmt::format("\nLeft out: {}\n{}", n, list);
}

PlotSeries guide(const std::string& name, double percent, std::size_t look, const PlotAxis& x) {
  PlotSeries line{name, PlotSeries::Style::kDashedLine, {*x.min, *x.max}, {percent, percent}};
  line.look = look;
  return line;
}

// Sets the axis to the whole decades that contain a range.
void set_decades(PlotAxis& axis, double from, double to) {
  axis.min = std::pow(10.0, std::floor(std::log10(from)));
  axis.max = std::max(10.0 * *axis.min, std::pow(10.0, std::ceil(std::log10(to))));
}

// error: relative; truth_std: 1/mm, to be divided by truth.
Plot error_plot(const std::vector<ModelsBenchRow>& rows, const std::string& name,
                double ModelsBenchRow::*error, double ModelsBenchRow::*truth_std,
                double Medium::*truth) {
  Plot plot;
  plot.title = fmt::format("Error of {} on shots rendered by volumetric Monte Carlo", name);
  plot.x = {"run time of one material and channel [s]", true};
  plot.y = {fmt::format("|estimate / truth - 1| of {} [%]", name), true};
  plot.legend_outside = true;
  plot.width_px = 1100;
  double from_s = INFINITY, to_s = 0.0, from = 0.5, to = 10.0;
  std::vector<double> floors;
  for (std::size_t m = 0; m < model_names().size(); ++m) {
    const std::string& model = model_names()[m];
    PlotSeries answered{model, PlotSeries::Style::kPoints, {}, {}};
    PlotSeries refused{fmt::format("{}, refused", model), PlotSeries::Style::kOpenPoints, {}, {}};
    answered.look = refused.look = m;
    for (const ModelsBenchRow& r : rows) {
      const double percent = 100.0 * std::abs(r.*error);
      if (r.model != model || !(percent > 0.0)) continue;
      PlotSeries& series = r.status == ModelsBenchStatus::kAnswered ? answered : refused;
      series.x.push_back(r.seconds);
      series.y.push_back(percent);
      from_s = std::min(from_s, r.seconds);
      to_s = std::max(to_s, r.seconds);
      from = std::min(from, percent);
      to = std::max(to, percent);
      const double floor = 100.0 * r.*truth_std / (r.material.medium.*truth);
      if (std::isfinite(floor)) floors.push_back(floor);
    }
    plot.series.push_back(answered);
    plot.series.push_back(refused);
  }
  if (!(to_s > 0.0)) return plot;
  set_decades(plot.x, from_s, to_s);
  set_decades(plot.y, from, to);
  plot.series.push_back(guide("5 %", 5.0, 4, plot.x));
  plot.series.push_back(guide("1 %", 1.0, 6, plot.x));
  if (!floors.empty()) {
    plot.series.push_back(guide("error of the shots", median(floors), 3, plot.x));
  }
  return plot;
}

}  // namespace

std::string models_bench_table(const std::vector<ModelsBenchRow>& rows) {
  return rows_text(rows) + summary_text(rows) + left_out_text(rows);
}

std::string models_bench_csv(const std::vector<ModelsBenchRow>& rows) {
  Csv csv({"body",
           "material",
           "channel",
           "eta",
           "truth_sigma_s_prime_per_mm",
           "truth_sigma_a_per_mm",
           "model",
           "status",
           "sigma_s_prime_per_mm",
           "sigma_s_prime_std_per_mm",
           "sigma_s_prime_truth_std_per_mm",
           "sigma_s_prime_error",
           "sigma_s_prime_z",
           "sigma_a_per_mm",
           "sigma_a_std_per_mm",
           "sigma_a_truth_std_per_mm",
           "sigma_a_error",
           "sigma_a_error_per_mm",
           "sigma_a_z",
           "monte_carlo_share",
           "truth_patch_std",
           "seconds",
           "cpu_seconds",
           "reason"});
  for (const ModelsBenchRow& r : rows) {
    const Medium& m = r.material.medium;
    csv.add_row({r.body,
                 r.material.name,
                 std::string(1, r.material.channel),
                 csv_number(m.eta_int_over_ext),
                 csv_number(m.sigma_s_prime_per_mm),
                 csv_number(m.sigma_a_per_mm),
                 r.model,
                 status_name(r.status),
                 csv_number(r.sigma_s_prime_per_mm.value),
                 csv_number(r.sigma_s_prime_per_mm.std),
                 csv_number(r.truth_std_sigma_s_prime_per_mm),
                 csv_number(r.error_sigma_s_prime),
                 csv_number(r.z_sigma_s_prime),
                 csv_number(r.sigma_a_per_mm.value),
                 csv_number(r.sigma_a_per_mm.std),
                 csv_number(r.truth_std_sigma_a_per_mm),
                 csv_number(r.error_sigma_a),
                 csv_number(r.error_sigma_a * m.sigma_a_per_mm),
                 csv_number(r.z_sigma_a),
                 csv_number(r.monte_carlo_share),
                 csv_number(r.truth_patch_std),
                 csv_number(r.seconds),
                 csv_number(r.cpu_seconds),
                 r.reason});
  }
  return csv.text();
}

Plot models_bench_plot_sigma_s_prime(const std::vector<ModelsBenchRow>& rows) {
  return error_plot(rows, "sigma_s'", &ModelsBenchRow::error_sigma_s_prime,
                    &ModelsBenchRow::truth_std_sigma_s_prime_per_mm, &Medium::sigma_s_prime_per_mm);
}

Plot models_bench_plot_sigma_a(const std::vector<ModelsBenchRow>& rows) {
  return error_plot(rows, "sigma_a", &ModelsBenchRow::error_sigma_a,
                    &ModelsBenchRow::truth_std_sigma_a_per_mm, &Medium::sigma_a_per_mm);
}

}  // namespace scattermeter::apps
