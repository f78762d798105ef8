#include "apps/pages/result_plots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "core/material/dipole.h"

namespace scattermeter::apps {
namespace {

// The colours of R, G and B in the palette of plot.cc.
std::size_t look_of(char channel) { return channel == 'R' ? 1 : channel == 'G' ? 2 : 0; }

PlotSeries dipole_series(const Estimate& e, double eta, double from_mm, double to_mm) {
  PlotSeries out;
  if (!e.converged || !(e.sigma_s_prime_per_mm.value > 0.0)) return out;
  const Dipole dipole({e.sigma_s_prime_per_mm.value, e.sigma_a_per_mm.value, eta});
  constexpr int kSteps = 120;
  for (int i = 0; i <= kSteps; ++i) {
    const double d = from_mm * std::pow(to_mm / from_mm, static_cast<double>(i) / kSteps);
    out.x.push_back(d);
    out.y.push_back(dipole.reflectance_per_mm2(d));
  }
  return out;
}

// Points of the 95 % ellipse: chi-square of two degrees of freedom, 5.991 = -2 ln 0.05.
PlotSeries ellipse(const Estimate& e, char channel) {
  PlotSeries out{"95 %", PlotSeries::Style::kLine, {}, {}};
  out.look = look_of(channel);
  const double radius = std::sqrt(-2.0 * std::log(0.05));
  const double rest = std::sqrt(std::max(0.0, 1.0 - e.correlation * e.correlation));
  constexpr int kSteps = 72;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = 2.0 * std::numbers::pi * i / kSteps;
    const double u = radius * std::cos(t);
    const double v = radius * std::sin(t);
    // Neither coefficient is negative.
    out.x.push_back(std::max(0.0, e.sigma_s_prime_per_mm.value + e.sigma_s_prime_per_mm.std * u));
    out.y.push_back(std::max(
        0.0, e.sigma_a_per_mm.value + e.sigma_a_per_mm.std * (e.correlation * u + rest * v)));
  }
  return out;
}

}  // namespace

std::vector<PagePlot> reflectance_plots(const ChannelResult& r) {
  if (!r.recovered) return {};
  PlotSeries seen{"image alone", PlotSeries::Style::kPoints, {}, {}};
  seen.look = look_of(r.channel);
  double from_mm = 0.0;
  double to_mm = 0.0;
  for (const ReflectanceKnot& k : r.recovered->knots) {
    if (!k.determined || !(k.distance_mm > 0.0)) continue;
    // With a free scale only the shape is known, not the level.
    const double log_std = std::isfinite(k.log_std) ? k.log_std : k.shape_log_std;
    seen.x.push_back(k.distance_mm);
    seen.y.push_back(k.r_per_mm2);
    seen.y_std.push_back(std::min(log_std, 0.9) * k.r_per_mm2);
    if (from_mm == 0.0) from_mm = k.distance_mm;
    to_mm = std::max(to_mm, k.distance_mm);
  }
  if (!(to_mm > from_mm)) return {};
  PagePlot out;
  out.plot.title = fmt::format("{} {}: r(d)", r.material, r.channel);
  out.plot.x = {"distance d [mm]", true};
  out.plot.y = {"r [1/mm^2]", true};
  const bool is_transport = r.model == "transport";
  PlotSeries answer = dipole_series(r.estimate, r.eta_int_over_ext, from_mm, to_mm);
  answer.look = 6;
  answer.name = is_transport ? "dipole for transport's estimate" : "dipole, fitted";
  if (is_transport) answer.style = PlotSeries::Style::kDashedLine;
  if (!answer.x.empty()) out.plot.series.push_back(answer);
  if (r.dipole) {
    PlotSeries own = dipole_series(*r.dipole, r.eta_int_over_ext, from_mm, to_mm);
    own.look = 4;
    own.name = "dipole, fitted";
    if (!own.x.empty()) out.plot.series.push_back(own);
  }
  out.plot.series.push_back(seen);
  out.caption = fmt::format(
      "{} {}: diffuse reflectance over distance, recovered from the image without a model (one "
      "standard deviation), and {}.",
      r.material, r.channel,
      is_transport
          ? "the dipole: as fitted, and with the coefficients estimated by transport; their "
            "difference is the effect of the shape of the body"
          : "the fitted dipole");
  return {out};
}

std::vector<PagePlot> ellipse_plots(const ChannelResult& r) {
  const Estimate& e = r.estimate;
  const Quantity& s = e.sigma_s_prime_per_mm;
  const Quantity& a = e.sigma_a_per_mm;
  if (!e.converged || !(s.std > 0.0) || !(a.std > 0.0) || !std::isfinite(s.std + a.std)) return {};
  constexpr double kShown = 6.0;  // standard deviations shown on each side
  PagePlot out;
  PlotSeries center{"answer", PlotSeries::Style::kPoints, {s.value}, {a.value}};
  center.look = look_of(r.channel);
  PlotSeries singles{"single shots", PlotSeries::Style::kOpenPoints, {}, {}};
  singles.look = center.look;
  for (const ShotResult& shot : r.singles) {
    const double x = shot.estimate.sigma_s_prime_per_mm.value;
    const double y = shot.estimate.sigma_a_per_mm.value;
    if (!shot.estimate.converged || std::abs(x - s.value) > kShown * s.std ||
        std::abs(y - a.value) > kShown * a.std) {
      continue;
    }
    singles.x.push_back(x);
    singles.y.push_back(y);
  }
  out.plot.series = {ellipse(e, r.channel), center};
  if (!singles.x.empty()) out.plot.series.push_back(singles);
  out.plot.title = fmt::format("{} {}: sigma_s' and sigma_a", r.material, r.channel);
  const auto range = [](const char* label, const Quantity& q) {
    return PlotAxis{label, false, std::max(0.0, q.value - kShown * q.std),
                    q.value + kShown * q.std};
  };
  out.plot.x = range("sigma_s' [1/mm]", s);
  out.plot.y = range("sigma_a [1/mm]", a);
  out.caption = fmt::format(
      "{} {}: 95 % region of the estimate (correlation {:.2f}); open: estimates from single shots, "
      "{} of {} within this plot.",
      r.material, r.channel, e.correlation, singles.x.size(), r.singles.size());
  return {out};
}

}  // namespace scattermeter::apps
