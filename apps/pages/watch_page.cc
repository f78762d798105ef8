#include "apps/pages/watch_page.h"

#include <algorithm>
#include <filesystem>

#include <fmt/core.h>
#include <fmt/format.h>

#include "apps/pages/html_page.h"
#include "apps/planning/plan.h"
#include "apps/report/result_table.h"

namespace scattermeter::apps {
namespace {

constexpr int kReload_s = 2;

std::string name_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

Html shot_table(const WatchState& state) {
  HtmlTable table;
  table.header = {"shot of the rig", "taken from", "remarks"};
  for (const AwaitedFile& f : state.files) {
    const auto at = state.taken.find(f.rig_name);
    const bool is_there = !f.taken_from.empty();
    table.rows.push_back(
        {text_cell(f.rig_name),
         is_there ? text_cell(name_of(f.taken_from), "pass") : text_cell("awaited"),
         text_cell(is_there && at != state.taken.end()
                       ? fmt::format("{}", fmt::join(at->second.verdict.remarks, "; "))
                       : "")});
  }
  return html_table(table);
}

Html pictures(const WatchState& state) {
  std::vector<Html> figures;
  const auto add = [&](const TakenShot& shot, const std::string& caption) {
    if (shot.png.empty()) return;
    figures.push_back(html_figure(data_address("image/png", shot.png), "shot " + name_of(shot.file),
                                  html_text(name_of(shot.file) + ": " + caption)));
  };
  for (const auto& [name, shot] : state.taken) add(shot, "taken as " + name);
  if (!state.rejected.empty()) {
    const TakenShot& last = state.rejected.back();
    add(last, "rejected: " + last.verdict.problems.front());
  }
  return html_figures(figures);
}

}  // namespace

std::vector<std::string> answer_lines(const RunningAnswer& answer) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < answer.channels.size(); ++i) {
    const ChannelResult& c = answer.channels[i];
    if (c.refused()) {
      out.push_back(fmt::format("{} not yet: {}", c.channel, c.estimate.reasons.front()));
      continue;
    }
    std::string line = fmt::format("{} sigma_s' {}, sigma_a {} /mm", c.channel,
                                   value_with_deviation(c.estimate.sigma_s_prime_per_mm),
                                   value_with_deviation(c.estimate.sigma_a_per_mm));
    if (i < answer.with_next.size()) {
      const auto relative = [](const Quantity& q) { return percent_text(q.std / q.value); };
      line +=
          fmt::format(" ({} and {}; with {} {} and {})", relative(c.estimate.sigma_s_prime_per_mm),
                      relative(c.estimate.sigma_a_per_mm), answer.next,
                      percent_text(answer.with_next[i][0]), percent_text(answer.with_next[i][1]));
    }
    out.push_back(line);
  }
  return out;
}

std::string watch_page(const WatchState& state) {
  const auto there = std::count_if(state.files.begin(), state.files.end(),
                                   [](const AwaitedFile& f) { return !f.taken_from.empty(); });
  const bool done = state.next.empty();
  const std::string headline = fmt::format("{} of {} shots taken", there, state.files.size());
  Html body = html_element("h1", html_text(headline));
  body += html_element("p", html_text(done ? "All shots are there." : "Next: " + state.next),
                       done ? "pass" : "");
  if (!state.lines.empty()) {
    const WatchLine& last = state.lines.back();
    body += html_element("p", html_text(last.text), last.css_class);
  }
  for (const auto& [material, answer] : state.answers) {
    body += html_element("h2", html_text(material + " so far, by the dipole"));
    Html list;
    for (const std::string& line : answer_lines(answer)) {
      list += html_element("li", html_text(line));
    }
    body += html_element("ul", list);
  }
  body += html_element("h2", html_text("Shots"));
  body += shot_table(state);
  body += pictures(state);
  Html log;
  for (auto line = state.lines.rbegin(); line != state.lines.rend(); ++line) {
    log += html_element("p", html_text(line->text), line->css_class);
  }
  body += html_details(fmt::format("log: {} lines, the last first", state.lines.size()), log);
  body += html_element("p", html_text(state.title), "dim");
  return html_document(headline, body, done ? 0 : kReload_s);
}

}  // namespace scattermeter::apps
