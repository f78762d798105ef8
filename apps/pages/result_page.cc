#include "apps/pages/result_page.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <fmt/format.h>

#include "apps/pages/budget_details.h"
#include "apps/pages/html_page.h"
#include "apps/pages/page_plots.h"
#include "apps/pages/residual_maps.h"
#include "apps/pages/result_headline.h"
#include "apps/pages/result_plots.h"
#include "apps/pages/rig_figure.h"
#include "apps/pages/swatches.h"
#include "apps/report/result_table.h"
#include "core/base/version.h"

namespace scattermeter::apps {
namespace {

constexpr int kMapWidth_px = 320;
constexpr std::size_t kMostMapBytes = 1'700'000;  // of all materials

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

// The channels of a material, and how it looks.
struct MaterialPart {
  std::vector<const ChannelResult*> channels;
  std::optional<MaterialLook> look;
};

std::vector<MaterialPart> parts_of(const Measurement& m) {
  std::vector<MaterialPart> parts;
  for (const ChannelResult& r : m.results) {
    if (parts.empty() || parts.back().channels.front()->material != r.material) {
      parts.emplace_back();
    }
    parts.back().channels.push_back(&r);
  }
  for (MaterialPart& part : parts) part.look = material_look(part.channels);
  return parts;
}

Html overview(const std::vector<MaterialPart>& parts) {
  HtmlTable table;
  table.header = {"material",      "ch",           "verdict",  "sigma_s' [1/mm]", "sigma_a [1/mm]",
                  "sigma_s' 95 %", "sigma_a 95 %", "residual", "chi2/n",          "model",
                  "shots",         "shots agree"};
  const auto add = [&](const ChannelResult& r, const Html& picture) {
    const Estimate& e = r.estimate;
    const bool known = e.converged;
    Html name = html_text(r.material);
    name += picture;
    table.rows.push_back(
        {{name, false, ""},
         text_cell(std::string(1, r.channel)),
         verdict(e),
         number_cell(known ? value_with_deviation(e.sigma_s_prime_per_mm) : "–"),
         number_cell(known ? value_with_deviation(e.sigma_a_per_mm) : "–"),
         number_cell(interval(e.sigma_s_prime_per_mm, known)),
         number_cell(interval(e.sigma_a_per_mm, known)),
         number_cell(known ? fmt::format("{:.2f} %", 100.0 * e.rms_relative) : "–"),
         number_cell(known ? fmt::format("{:.2f}", e.reduced_chi2) : "–"),
         text_cell(r.model),
         number_cell(std::to_string(r.shots.size())),
         r.agreement.dof == 0 ? text_cell("–")
         : r.agreement.disagree()
             ? text_cell(fmt::format("no (p = {:.1g})", r.agreement.p_value), "fail")
             : text_cell("yes", "pass")});
  };
  for (const MaterialPart& part : parts) {
    for (const ChannelResult* r : part.channels) {
      const bool is_first = r == part.channels.front();
      add(*r, part.look && is_first ? look_picture(*part.look, r->material) : Html{});
    }
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
  const auto line = [](const std::string& text) {
    return html_element("p", html_text(text), "dim");
  };
  Html out;
  if (!parts.empty()) {
    out += line(fmt::format("Skipped without effect on the results: {}.", fmt::join(parts, ", ")));
  }
  if (s.rows > 0) {
    out += line(
        fmt::format("{} patches in the shots were left out, as the others reach the precision that "
                    "was asked for; in maps, each patch in use stands for its neighbours.",
                    s.rows));
  }
  return out;
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

// Observed, model and difference, by shot and channel.
Html maps(const std::vector<const ChannelResult*>& channels, double full_scale_percent,
          std::size_t most_bytes) {
  const std::vector<ChannelShot> shots = shots_to_map(channels, most_bytes);
  if (shots.empty()) return {};
  std::size_t all = 0;
  HtmlTable table;
  table.header = {"shot", "channel", "rms of the difference"};
  for (const ChannelResult* r : channels) {
    all += r->rows.size();
    for (const ShotRows& rows : r->rows) {
      table.rows.push_back({text_cell(rows.file), text_cell(std::string(1, r->channel)),
                            number_cell(fmt::format("{:.2g} %", 100.0 * relative_rms(rows)))});
    }
  }
  const std::string chosen =
      shots.size() < all
          ? fmt::format(" Shown are the {} of {} maps whose shots depart most.", shots.size(), all)
          : "";
  Html out = html_widget(
      "maps", residual_map_data(shots, kMapWidth_px, full_scale_percent),
      html_text(fmt::format("Observed, model and difference of {}. One scale for all differences "
                            "of this page: blue to red, ±{:g} % of the brightest place of the "
                            "shot.{}",
                            channels.front()->material, full_scale_percent, chosen)));
  out += html_details("differences of all shots", html_table(table));
  return out;
}

Html material_section(const MaterialPart& part, double full_scale_percent, std::size_t most_bytes) {
  const std::vector<const ChannelResult*>& channels = part.channels;
  Html out = html_element("h2", html_text(channels.front()->material));
  out += swatches(channels, part.look);
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
  out += maps(channels, full_scale_percent, most_bytes);
  return out;
}

}  // namespace

std::string result_page(const Measurement& m, const std::string& command_line) {
  const auto refused =
      std::count_if(m.results.begin(), m.results.end(), [](const auto& r) { return r.refused(); });
  const std::vector<MaterialPart> parts = parts_of(m);
  std::vector<std::string> materials;
  for (const MaterialPart& part : parts) materials.push_back(part.channels.front()->material);
  const std::string title =
      fmt::format("Scattering and absorption of {}", fmt::join(materials, ", "));
  Html body = html_element("h1", html_text(title));
  body += html_element(
      "p",
      html_text(refused == 0 ? fmt::format("All {} values measured.", m.results.size())
                             : fmt::format("{} of {} values refused.", refused, m.results.size())),
      refused == 0 ? "pass" : "fail");
  for (const std::string& sentence :
       {precision_sentence(m), rests_on_sentence(m), next_sentence(m)}) {
    if (!sentence.empty()) body += html_element("p", html_text(sentence));
  }
  body += reasons(m);
  body += overview(parts);
  double total_s = 0.0;
  for (const auto& [stage, seconds] : m.timing_s) {
    if (stage == "total") total_s = seconds;
  }
  body += html_element(
      "p",
      html_text(fmt::format("{} ({:.1f} s, scattermeter {})", command_line, total_s, kVersion)),
      "dim");
  for (const std::string& note : m.notes) body += html_element("p", html_text(note), "dim");
  body += skipped(m.skipped);
  for (const MergedBracket& b : m.brackets) {
    body += html_element("p", html_text("Bracket " + bracket_text(b) + "."), "dim");
  }
  if (m.places) {
    body += html_element("h2", html_text("The rig"));
    body += rig_figure(*m.places);
  }
  double full_scale_percent = 0.0;
  for (const ChannelResult& r : m.results) {
    for (const ShotRows& rows : r.rows) {
      full_scale_percent = std::max(full_scale_percent, difference_scale_percent(rows));
    }
  }
  for (const MaterialPart& part : parts) {
    body += material_section(part, full_scale_percent, kMostMapBytes / parts.size());
  }
  HtmlTable inputs;
  inputs.header = {"file", "sha256"};
  for (const InputFile& f : m.inputs) {
    inputs.rows.push_back({text_cell(f.path), text_cell(f.sha256)});
  }
  body += html_element("h2", html_text("Inputs"));
  body += html_details(fmt::format("{} files", m.inputs.size()), html_table(inputs));
  return html_document(title, body);
}

}  // namespace scattermeter::apps
