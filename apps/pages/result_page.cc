#include "apps/pages/result_page.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/pages/budget_details.h"
#include "apps/pages/html_page.h"
#include "apps/pages/page_plots.h"
#include "apps/pages/residual_maps.h"
#include "apps/pages/result_plots.h"
#include "apps/report/result_table.h"
#include "core/base/version.h"

namespace scattermeter::apps {
namespace {

constexpr int kMapWidth_px = 150;
constexpr std::size_t kMapsPerChannel = 24;

std::string interval(const Quantity& q, bool known) {
  if (!known) return "–";
  // Enough digits to distinguish the two ends.
  const double width = q.high95 - q.low95;
  const int decimals = width > 0.0 && std::isfinite(width)
                           ? std::clamp(1 - static_cast<int>(std::floor(std::log10(width))), 0, 8)
                           : 4;
  return fmt::format("{:.{}f} … {:.{}f}", q.low95, decimals, q.high95, decimals);
}

HtmlTable::Cell verdict(const Estimate& e) {
  return e.reasons.empty() ? text_cell("ok", "pass") : text_cell("refused", "fail");
}

Html overview(const Measurement& m) {
  HtmlTable table;
  table.header = {
      "material",     "",         "verdict", "sigma_s' [1/mm]", "sigma_a [1/mm]", "sigma_s' 95 %",
      "sigma_a 95 %", "residual", "chi2/n",  "model",           "shots",          "shots agree"};
  for (const ChannelResult& r : m.results) {
    const Estimate& e = r.estimate;
    const bool known = e.converged;
    table.rows.push_back(
        {text_cell(r.material), text_cell(std::string(1, r.channel)), verdict(e),
         number_cell(known ? value_with_deviation(e.sigma_s_prime_per_mm) : "–"),
         number_cell(known ? value_with_deviation(e.sigma_a_per_mm) : "–"),
         number_cell(interval(e.sigma_s_prime_per_mm, known)),
         number_cell(interval(e.sigma_a_per_mm, known)),
         number_cell(known ? fmt::format("{:.2f} %", 100.0 * e.rms_relative) : "–"),
         number_cell(known ? fmt::format("{:.2f}", e.reduced_chi2) : "–"), text_cell(r.model),
         number_cell(std::to_string(r.shots.size())),
         r.agreement.dof == 0 ? text_cell("–")
         : r.agreement.disagree()
             ? text_cell(fmt::format("no (p = {:.1g})", r.agreement.p_value), "fail")
             : text_cell("yes", "pass")});
  }
  return html_table(table);
}

Html skipped(const Skipped& s) {
  std::vector<std::string> parts;
  const auto add = [&](std::size_t n, const char* what) {
    if (n > 0) parts.push_back(fmt::format("{} {}", n, what));
  };
  add(s.shots_not_asked, "shots not requested");
  add(s.channels_not_asked, "channels not requested");
  add(s.shots_from_cache, "shots taken from the cache");
  add(s.samples_outside, "samples outside the objects");
  add(s.patches_unseen, "patches that no shot sees");
  add(s.patches_unlit, "patches that a light does not reach");
  add(s.shadow_rays, "shadow rays on convex objects");
  add(s.nuisances, "causes of error too small to count");
  if (parts.empty()) return {};
  return html_element(
      "p",
      html_text(fmt::format("Skipped without effect on the results: {}.", fmt::join(parts, ", "))),
      "dim");
}

// The reasons for refusals and for the use of the transport model.
Html reasons(const Measurement& m) {
  Html list;
  for (const ChannelResult& r : m.results) {
    for (const std::string& reason : r.estimate.reasons) {
      list += html_element(
          "li", html_text(fmt::format("{} {} is refused: {}.", r.material, r.channel, reason)));
    }
    if (!r.why_transport.empty()) {
      const std::optional<DipoleDistance> far = dipole_distance(r);
      list += html_element(
          "li",
          html_text(fmt::format(
              "{} {} is estimated by transport: {}.{}", r.material, r.channel, r.why_transport,
              far ? fmt::format(" The dipole lies {:+.2g} % off in sigma_s' and {:+.1g}/mm in "
                                "sigma_a.",
                                100.0 * far->sigma_s_prime_relative, far->sigma_a_per_mm)
                  : "")));
    }
  }
  return list.markup.empty() ? Html{} : html_element("ul", list);
}

Html single_shots(const std::vector<const ChannelResult*>& channels) {
  HtmlTable table;
  table.header = {"shot", "channel", "sigma_s' [1/mm]", "sigma_a [1/mm]", "verdict"};
  for (const ChannelResult* r : channels) {
    for (const ShotResult& s : r->singles) {
      const Estimate& e = s.estimate;
      table.rows.push_back(
          {text_cell(s.file), text_cell(std::string(1, r->channel)),
           number_cell(e.converged ? value_with_deviation(e.sigma_s_prime_per_mm) : "–"),
           number_cell(e.converged ? value_with_deviation(e.sigma_a_per_mm) : "–"), verdict(e)});
    }
  }
  return table.rows.empty() ? Html{} : html_table(table);
}

// Why patches were excluded.
std::string left_out(const ChannelResult& r) {
  return fmt::format("{}: {}", r.channel, patches_text(r.patches_by_state, r.patches_partly_seen));
}

Html maps(const std::vector<const ChannelResult*>& channels, double full_scale_percent) {
  std::vector<const ShotRows*> all;
  std::vector<char> names;
  std::size_t more = 0;
  for (const ChannelResult* r : channels) {
    for (std::size_t i = 0; i < std::min(r->rows.size(), kMapsPerChannel); ++i) {
      all.push_back(&r->rows[i]);
      names.push_back(r->channel);
    }
    more = std::max(more, r->rows.size() - std::min(r->rows.size(), kMapsPerChannel));
  }
  std::vector<Html> figures(all.size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
    const ResidualMap map = residual_map(*all[i], kMapWidth_px, full_scale_percent);
    const std::string caption = fmt::format("{} {}: observed, model, difference; rms {:.2g} %",
                                            all[i]->file, names[i], 100.0 * map.rms_relative);
    figures[i] =
        html_figure(data_address("image/png", png_bytes(map.picture)), caption, html_text(caption));
  });
  Html out = html_figures(figures);
  if (more > 0) {
    out += html_element("p", html_text(fmt::format("{} more shots are not shown.", more)), "dim");
  }
  return out;
}

Html material_section(const std::vector<const ChannelResult*>& channels,
                      double full_scale_percent) {
  Html out = html_element("h2", html_text(channels.front()->material));
  std::vector<PagePlot> plots;
  for (const ChannelResult* r : channels) {
    for (PagePlot& plot : reflectance_plots(*r)) plots.push_back(std::move(plot));
  }
  for (const ChannelResult* r : channels) {
    for (PagePlot& plot : ellipse_plots(*r)) plots.push_back(std::move(plot));
  }
  if (!plots.empty()) out += plot_figures(plots);
  Html budgets;
  for (const ChannelResult* r : channels) budgets += budget_details(r->channel, r->estimate);
  if (!budgets.markup.empty()) {
    out += html_element("h3", html_text("Where the uncertainty comes from"));
    out += html_element("p", html_text(kBudgetLegend), "dim");
    out += budgets;
  }
  if (const Html table = single_shots(channels); !table.markup.empty()) {
    out += html_element("h3", html_text("Single shots"));
    for (const ChannelResult* r : channels) {
      if (r->agreement.dof == 0) continue;
      out +=
          html_element("p",
                       html_text(fmt::format(
                           "{}: the shots {} (chi2 {:.1f} at {} degrees of freedom, p = "
                           "{:.2g}){}",
                           r->channel, r->agreement.disagree() ? "do not agree" : "agree",
                           r->agreement.chi2, r->agreement.dof, r->agreement.p_value,
                           r->agreement.disagree() ? "; the uncertainties are increased." : ".")),
                       "dim");
    }
    out += html_details("estimates from single shots", table);
  }
  out += html_element("h3", html_text("Observed, model, difference"));
  for (const ChannelResult* r : channels) {
    out += html_element("p", html_text(left_out(*r)), "dim");
  }
  out += html_element("p",
                      html_text(fmt::format("Differences on all maps of this page: blue to red, "
                                            "±{:g} % of the brightest place of the shot.",
                                            full_scale_percent)),
                      "dim");
  out += maps(channels, full_scale_percent);
  return out;
}

}  // namespace

std::string result_page(const Measurement& m, const std::string& command_line) {
  const auto refused =
      std::count_if(m.results.begin(), m.results.end(), [](const auto& r) { return r.refused(); });
  Html body = html_element("h1", html_text("Scattering and absorption"));
  body += html_element(
      "p",
      html_text(refused == 0 ? fmt::format("All {} values measured.", m.results.size())
                             : fmt::format("{} of {} values refused.", refused, m.results.size())),
      refused == 0 ? "pass" : "fail");
  double total_s = 0.0;
  for (const auto& [stage, seconds] : m.timing_s) {
    if (stage == "total") total_s = seconds;
  }
  body += html_element(
      "p",
      html_text(fmt::format("{} ({:.1f} s, scattermeter {})", command_line, total_s, kVersion)),
      "dim");
  body += overview(m);
  body += reasons(m);
  for (const std::string& note : m.notes) body += html_element("p", html_text(note), "dim");
  body += skipped(m.skipped);
  for (const MergedBracket& b : m.brackets) {
    body += html_element("p", html_text("Bracket " + bracket_text(b) + "."), "dim");
  }
  body += html_element(
      "p",
      html_text("In the observations, areas at silhouettes and creases, which are not used, are "
                "dark, clipped areas red, and other excluded areas orange."),
      "dim");
  double full_scale_percent = 0.0;
  for (const ChannelResult& r : m.results) {
    for (const ShotRows& rows : r.rows) {
      full_scale_percent = std::max(full_scale_percent, difference_scale_percent(rows));
    }
  }
  for (std::size_t i = 0; i < m.results.size();) {
    std::vector<const ChannelResult*> channels;
    const std::string& material = m.results[i].material;
    for (; i < m.results.size() && m.results[i].material == material; ++i) {
      channels.push_back(&m.results[i]);
    }
    body += material_section(channels, full_scale_percent);
  }
  HtmlTable inputs;
  inputs.header = {"file", "sha256"};
  for (const InputFile& f : m.inputs) {
    inputs.rows.push_back({text_cell(f.path), text_cell(f.sha256)});
  }
  body += html_element("h2", html_text("Inputs"));
  body += html_details(fmt::format("{} files", m.inputs.size()), html_table(inputs));
  return html_document("Scattering and absorption", body);
}

}  // namespace scattermeter::apps
