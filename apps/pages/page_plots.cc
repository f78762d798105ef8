#include "apps/pages/page_plots.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/pages/page_number.h"

namespace scattermeter::apps {
namespace {

using Json = nlohmann::ordered_json;

const char* style_name(PlotSeries::Style style) {
  switch (style) {
    case PlotSeries::Style::kLine:
      return "line";
    case PlotSeries::Style::kDashedLine:
      return "dashed";
    case PlotSeries::Style::kPoints:
      return "points";
    case PlotSeries::Style::kOpenPoints:
      return "open_points";
    case PlotSeries::Style::kLineAndPoints:
      return "line_points";
    case PlotSeries::Style::kBoxes:
      return "boxes";
    case PlotSeries::Style::kArrows:
      return "arrows";
    case PlotSeries::Style::kCells:
      return "cells";
  }
  return "";
}

Json number(double value) {
  return std::isfinite(value) ? Json(page_number(value)) : Json(nullptr);
}

Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json axis_data(const PlotAxis& axis) {
  return {{"label", plain_text(axis.label)},
          {"log", axis.log},
          {"min", number(axis.min)},
          {"max", number(axis.max)}};
}

Json series_data(const Plot& plot, const PlotSeries& s) {
  const auto usable = [](const PlotAxis& axis, double v) {
    return std::isfinite(v) && (!axis.log || v > 0.0);
  };
  const std::pair<const char*, const std::vector<double>*> lists[] = {
      {"x", &s.x},   {"y", &s.y},   {"std", &s.y_std},
      {"dx", &s.dx}, {"dy", &s.dy}, {"value", &s.value}};
  Json out = {{"name", plain_text(s.name)}, {"style", style_name(s.style)}};
  out["look"] = s.look ? Json(*s.look) : Json(nullptr);
  for (const auto& [name, values] : lists) {
    const bool may_be_missing = values != &s.x && values != &s.y;
    if (values->size() == s.x.size() || (may_be_missing && values->empty())) continue;
    throw std::invalid_argument(fmt::format("plot_data: series {} has {} x, {} {}", s.name,
                                            s.x.size(), values->size(), name));
  }
  for (const auto& [name, values] : lists) {
    if (values->empty()) continue;
    Json list = Json::array();
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      if (usable(plot.x, s.x[i]) && usable(plot.y, s.y[i])) list.push_back(number((*values)[i]));
    }
    if (list.empty()) return nullptr;
    out[name] = list;
  }
  return s.x.empty() ? Json(nullptr) : out;
}

}  // namespace

std::string plot_data(const Plot& plot) {
  Json all = Json::array();
  for (const PlotSeries& s : plot.series) {
    const Json series = series_data(plot, s);
    if (!series.is_null()) all.push_back(series);
  }
  if (all.empty()) return "";
  const Json out = {{"title", plain_text(plot.title)},
                    {"x", axis_data(plot.x)},
                    {"y", axis_data(plot.y)},
                    {"y_down", plot.y_down},
                    {"equal", plot.equal_axes},
                    {"colours",
                     {{"label", plain_text(plot.colours.label)},
                      {"full_scale", number(plot.colours.full_scale)},
                      {"min", number(plot.colours.min)},
                      {"log", plot.colours.log}}},
                    {"series", all}};
  return out.dump();
}

Html plot_figures(const std::vector<PagePlot>& plots) {
  std::vector<Html> figures;
  for (const PagePlot& p : plots) {
    const std::string data = plot_data(p.plot);
    if (!data.empty()) figures.push_back(html_widget("plot", data, html_text(p.caption)));
  }
  return html_figures(figures);
}

}  // namespace scattermeter::apps
