#include "apps/pages/check_page.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "apps/pages/html_page.h"
#include "apps/pages/led_plots.h"
#include "apps/pages/page_plots.h"
#include "apps/pages/rig_figure.h"
#include "apps/report/radiance_plots.h"
#include "core/base/version.h"

namespace scattermeter::apps {
namespace {

// The least number of samples for a point of the variance.
constexpr std::size_t kLeastTriples = 50;

std::string figure_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "–";
}

Html summary(const CheckReport& report) {
  HtmlTable table;
  table.header = {"check", "verdict", "worst", "limit", "unit", "worst at", "what to do", "rms"};
  for (const CheckItem& item : report.items) {
    const bool judged = !item.details.empty();
    const std::string limit = fmt::format("{}{:.3g}", item.at_least ? "≥ " : "≤ ", item.limit);
    table.rows.push_back({text_cell(item.what),
                          !judged       ? text_cell("not judged", "dim")
                          : item.passed ? text_cell("pass", "pass")
                                        : text_cell("FAIL", "fail"),
                          number_cell(figure_text(item.worst)), number_cell(limit),
                          text_cell(item.unit), text_cell(item.where),
                          text_cell(item.passed ? "" : item.advice),
                          number_cell(figure_text(item.rms))});
  }
  return html_table(table);
}

// Residuals of the pose points, as magnified arrows.
std::vector<PagePlot> pose_plots(const CheckedRig& checked) {
  if (!checked.shared_pose) return {};
  const PoseResult& pose = *checked.shared_pose;
  const CameraIntrinsics& k = checked.rig.scene.camera.intrinsics;
  double longest = 0.0;
  for (const Eigen::Vector2d& r : pose.residuals_px) {
    if (r.allFinite()) longest = std::max(longest, r.norm());
  }
  if (!(longest > 0.0)) return {};
  // The longest spans about a tenth of the frame; the factor is a round number.
  const double factor = std::pow(10.0, std::floor(std::log10(0.1 * k.width_px / longest)));
  PlotSeries inliers{"", PlotSeries::Style::kArrows, {}, {}};
  inliers.look = 0;
  PlotSeries outliers{"outliers", PlotSeries::Style::kArrows, {}, {}};
  outliers.look = 1;
  PlotSeries points{"points", PlotSeries::Style::kOpenPoints, {}, {}};
  points.look = 1;
  for (std::size_t i = 0; i < pose.residuals_px.size(); ++i) {
    const Eigen::Vector2d& at = checked.rig.pose.points[i].image_px;
    PlotSeries& s = pose.inlier[i] ? inliers : outliers;
    s.x.push_back(at.x());
    s.y.push_back(at.y());
    s.dx.push_back(factor * pose.residuals_px[i].x());
    s.dy.push_back(factor * pose.residuals_px[i].y());
    points.x.push_back(at.x());
    points.y.push_back(at.y());
  }
  Plot plot;
  plot.title = fmt::format("pose residuals, {:g} times as long", factor);
  plot.x = {"x [px]", false, 0.0, static_cast<double>(k.width_px)};
  plot.y = {"y [px]", false, 0.0, static_cast<double>(k.height_px)};
  plot.y_down = true;
  plot.series = {points, inliers};
  if (!outliers.x.empty()) plot.series.push_back(outliers);
  return {
      {plot, fmt::format("Residuals of the {} pose points over the frame: rms {:.3g} px, worst "
                         "{:.3g} px. Arrows of one direction in a part of the frame indicate an "
                         "error of the lens, single long ones a mistyped point.",
                         pose.residuals_px.size(), pose.rms_px, pose.worst_px)}};
}

// The details of an item over the number of the shot, one series for each channel or light.
PagePlot over_shots(const CheckedRig& checked, const CheckItem& item, const std::string& caption) {
  std::map<std::string, PlotSeries> series;
  for (const CheckDetail& d : item.details) {
    if (d.shot_idx == CheckDetail::npos) continue;
    const std::string& file = checked.rig.scene.shots[d.shot_idx].file;
    const std::string channel = d.where.size() > file.size() ? d.where.substr(file.size() + 1) : "";
    PlotSeries& s = series[channel];
    s.name = channel;
    s.style = PlotSeries::Style::kPoints;
    s.x.push_back(static_cast<double>(d.shot_idx + 1));
    s.y.push_back(d.value);
    if (std::isfinite(d.std)) s.y_std.push_back(d.std);
  }
  PagePlot out;
  out.caption = caption;
  out.plot.title = item.what + " by shot";
  out.plot.legend_above = true;
  const double n = static_cast<double>(checked.rig.scene.shots.size());
  out.plot.x = {"shot, in the rig's order", false, 0.5, n + 0.5};
  out.plot.y = {item.what + " [" + item.unit + "]"};
  for (auto& [name, s] : series) {
    if (s.y_std.size() != s.y.size()) s.y_std.clear();
    s.look = name == "R" ? 1 : name == "G" ? 2 : 0;
    out.plot.series.push_back(s);
  }
  return out;
}

std::vector<PagePlot> trends(const CheckedRig& checked, const CheckReport& report) {
  const std::vector<std::pair<std::string, std::string>> wanted = {
      {"light of shot",
       "The light of each shot relative to the joint model of its material. A slope is an LED that "
       "drifts, "
       "a "
       "single step an aperture, an exposure or a current that changed."},
      {"light from elsewhere",
       "Uniform light besides the lamps of the rig, such as from a lamp left on."},
      {"background", "The darkest background above the file's black level."},
      {"black drift",
       "Change of the black level from its usual value: it drifts with temperature."},
      {"noise", "Variance of neighbouring samples relative to the noise model: 0 if it is right."},
      {"clipped", "Samples at the top of their range."}};
  std::vector<PagePlot> out;
  for (const auto& [what, caption] : wanted) {
    for (const CheckItem& item : report.items) {
      if (item.what == what && !item.details.empty()) {
        out.push_back(over_shots(checked, item, caption));
      }
    }
  }
  return out;
}

// Variance as a function of the mean for all shots, one plot for each channel.
std::vector<PagePlot> noise_plots(const CheckedRig& checked) {
  std::vector<PagePlot> out;
  for (std::size_t c = 0; c < kRgb; ++c) {
    PlotSeries seen{"shots", PlotSeries::Style::kPoints, {}, {}};
    seen.look = c == 0 ? 1 : c == 1 ? 2 : 0;
    std::vector<std::pair<double, double>> model;
    for (const CheckedFrame& frame : checked.frames) {
      for (const capture::NoisePoint& p : frame.noise[c]) {
        if (p.triples < kLeastTriples) continue;
        seen.x.push_back(p.mean_counts);
        seen.y.push_back(p.variance_counts2);
        seen.y_std.push_back(p.relative_std * p.variance_counts2);
        model.emplace_back(p.mean_counts, p.model_counts2);
      }
    }
    std::sort(model.begin(), model.end());
    PlotSeries line{"noise model", PlotSeries::Style::kLine, {}, {}};
    line.look = 6;
    for (const auto& [x, y] : model) {
      line.x.push_back(x);
      line.y.push_back(y);
    }
    PagePlot plot;
    plot.plot.title = fmt::format("noise, {}", kRgbName[c]);
    plot.plot.x = {"mean [counts above black]", true};
    plot.plot.y = {"variance [counts^2]", true};
    plot.plot.series = {line, seen};
    plot.plot.legend_above = true;
    plot.caption = fmt::format(
        "Variance over mean in {}, each shot in half octaves of its signal, with the noise model "
        "of "
        "the rig. Points above it at the bright end indicate another gain, at the dark end more "
        "read "
        "noise.",
        kRgbName[c]);
    out.push_back(plot);
  }
  return out;
}

// The measurements behind the radiance calibration.
std::vector<PagePlot> radiance_plots(const CheckedRig& checked) {
  if (!checked.rig.decoding.radiance) return {};
  const capture::RadianceCalibration& calibration = *checked.rig.decoding.radiance;
  std::vector<PagePlot> out = {
      {linearity_plot(calibration),
       "Recorded signal relative to that of a camera with the sensitivity at zero signal: the "
       "curve "
       "that is removed from every shot, its standard deviation, and the means of the flats in "
       "half "
       "octaves of their signal. Points beyond the dashed lines by more than their error bars: the "
       "lamp drifted, or the curve is less smooth than the model; at the dark end a tenth of "
       "a "
       "count of the black shows."}};
  for (std::size_t c = 0; c < kRgb; ++c) {
    out.push_back({photon_transfer_plot(calibration, c),
                   fmt::format("Variance over signal in {} of the pairs of flats, as recorded, and "
                               "the noise model with a gain of {:.4g} e/count and a read noise of "
                               "{:.3g} counts.",
                               kRgbName[c], calibration.correction.noise[c].gain_e_per_count,
                               calibration.correction.noise[c].read_noise_counts)});
  }
  return out;
}

Html pictures(const CheckedRig& checked) {
  std::vector<Html> figures;
  for (std::size_t i = 0; i < checked.shots.size(); ++i) {
    if (checked.frames[i].png.empty()) continue;
    const ObservedShot& shot = checked.shots[i];
    std::size_t clipped = 0;
    for (const ChannelObservation& o : shot.observation.channel) {
      clipped += o.samples_clipped;
    }
    std::string lights;
    for (const std::string& name : shot.stated->lights)
      lights += (lights.empty() ? "" : ", ") + name;
    const std::string caption =
        fmt::format("{}: {} of {}, lit by {}; {:g} s, f/{:g}, ISO {:g}; {} samples clipped",
                    shot.stated->file, shot.stated->object, shot.stated->material, lights,
                    shot.exposure_s, shot.f_number, shot.iso, clipped);
    figures.push_back(html_figure(data_address("image/png", checked.frames[i].png),
                                  "shot " + shot.stated->file, html_text(caption)));
  }
  return html_figures(figures);
}

Html every_value(const CheckReport& report) {
  Html out;
  for (const CheckItem& item : report.items) {
    if (item.details.empty()) continue;
    HtmlTable table;
    table.header = {"where", "value [" + item.unit + "]", "std"};
    for (const CheckDetail& d : item.details) {
      table.rows.push_back(
          {text_cell(d.where), number_cell(figure_text(d.value)), number_cell(figure_text(d.std))});
    }
    out += html_details(fmt::format("{}: {} values", item.what, item.details.size()),
                        html_table(table));
  }
  return out;
}

}  // namespace

std::string check_page(const CheckedRig& checked, const CheckReport& report,
                       const std::string& command_line) {
  const auto failed = std::count_if(report.items.begin(), report.items.end(),
                                    [](const CheckItem& i) { return !i.passed; });
  Html body = html_element("h1", html_text("Rig check"));
  body += html_element(
      "p",
      html_text(failed == 0 ? fmt::format("All {} checks passed.", report.items.size())
                            : fmt::format("{} of {} checks failed.", failed, report.items.size())),
      failed == 0 ? "pass" : "fail");
  if (!report.cause.empty()) {
    body += html_element("p", html_text("Most probable cause: " + report.cause), "fail");
  }
  body += html_element("p",
                       html_text(fmt::format("{}, {} shots. {} (scattermeter {})", checked.rig.path,
                                             checked.shots.size(), command_line, kVersion)),
                       "dim");
  body += summary(report);
  for (const std::string& note : report.notes) body += html_element("p", html_text(note), "dim");
  const auto section = [&](const std::string& title, const std::vector<PagePlot>& plots) {
    if (plots.empty()) return;
    body += html_element("h2", html_text(title));
    body += plot_figures(plots);
  };
  if (checked.geometry) {
    body += html_element("h2", html_text("The rig"));
    body += rig_figure(rig_places(checked.rig, checked.geometry->objects, checked.shots));
  }
  section("Pose", pose_plots(checked));
  section("Over the shots", trends(checked, report));
  section("Noise", noise_plots(checked));
  section("White planes under the LEDs", led_plane_plots(checked.leds));
  section("Radiance calibration", radiance_plots(checked));
  body += html_element("h2", html_text("Shots"));
  body += html_element(
      "p", html_text(
               "Grey is the light on the sensor, with the edges of the mesh as projected by camera "
               "and pose: contour orange, steps pink, creases blue. They should coincide with the "
               "edges of the object. Clipped samples are red."));
  body += pictures(checked);
  body += html_element("h2", html_text("All values"));
  body += every_value(report);
  return html_document(fmt::format("Rig check: {}", failed == 0 ? "passed" : "FAILED"), body);
}

}  // namespace scattermeter::apps
