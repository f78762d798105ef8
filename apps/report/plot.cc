#include "apps/report/plot.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>
#include <unistd.h>

#include "apps/report/child_process.h"
#include "capture/files/pending_file.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

// The palette of B. Wong, suitable for colour-blind readers (Nature Methods 8, 441, 2011).
constexpr const char* kColours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                    "#E69F00", "#56B4E9", "#000000", "#F0E442"};

// Within gnuplot's single quotes only the quote itself is special; it is doubled.
std::string gnuplot_quoted(const std::string& text) {
  std::string out = "'";
  for (char c : text) {
    if (c == '\'') out += '\'';
    const auto byte = static_cast<unsigned char>(c);
    out += byte < 0x20U || byte == 0x7FU ? ' ' : c;
  }
  return out + "'";
}

// A round step of which the range holds at most five.
double tic_step(double range) {
  const double decade = std::pow(10.0, std::floor(std::log10(range / 5.0)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (range <= 5.0 * step * decade) return step * decade;
  }
  return 10.0 * decade;
}

std::string axis(const char* name, const PlotAxis& a, bool reversed) {
  const auto end = [](const std::optional<double>& v) { return v ? fmt::format("{}", *v) : "*"; };
  const auto ends = reversed && a.min && a.max ? std::pair(end(a.max), end(a.min))
                                               : std::pair(end(a.min), end(a.max));
  // gnuplot's own steps leave no room between long labels.
  std::string steps;
  if (!a.log && a.min && a.max && *a.max > *a.min) {
    steps = fmt::format("set {}tics {:g}\n", name, tic_step(*a.max - *a.min));
  }
  // gnuplot applies `reverse` only if it chooses at least one end of the range itself.
  return fmt::format("{6}set {0}label {1} noenhanced\n{2}set {0}range [{3}:{4}]{5}\n", name,
                     gnuplot_quoted(a.label),
                     a.log ? fmt::format("set logscale {0}\nset format {0} '%g'\n", name) : "",
                     ends.first, ends.second, reversed && !(a.min && a.max) ? " reverse" : "",
                     steps);
}

bool can_stand(const PlotAxis& a, double value) {
  return std::isfinite(value) && (!a.log || value > 0.0);
}

// A data block of the points that can be drawn; counts them.
std::string data_block(const Plot& plot, std::size_t index, std::size_t& drawn) {
  const PlotSeries& s = plot.series[index];
  if (s.x.size() != s.y.size() || (!s.y_std.empty() && s.y_std.size() != s.x.size())) {
    throw std::invalid_argument(fmt::format("write_plot: series {} has {} x, {} y, {} y_std",
                                            s.name, s.x.size(), s.y.size(), s.y_std.size()));
  }
  const bool cells = s.style == PlotSeries::Style::kCells;
  const bool arrows = s.style == PlotSeries::Style::kArrows || cells;
  if (cells && s.value.size() != s.x.size()) {
    throw std::invalid_argument(fmt::format("write_plot: series {} has {} x, {} values", s.name,
                                            s.x.size(), s.value.size()));
  }
  if (arrows && (s.dx.size() != s.x.size() || s.dy.size() != s.x.size())) {
    throw std::invalid_argument(fmt::format("write_plot: series {} has {} x, {} dx, {} dy", s.name,
                                            s.x.size(), s.dx.size(), s.dy.size()));
  }
  std::string out = fmt::format("$series{} << END_OF_DATA\n", index);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (!can_stand(plot.x, s.x[i]) || !can_stand(plot.y, s.y[i])) continue;
    if (arrows) {
      if (!std::isfinite(s.dx[i]) || !std::isfinite(s.dy[i])) continue;
      if (cells && !std::isfinite(s.value[i])) continue;
      out += cells ? fmt::format("{} {} {} {} {} {} {}\n", s.x[i], s.y[i], s.x[i] - 0.5 * s.dx[i],
                                 s.x[i] + 0.5 * s.dx[i], s.y[i] - 0.5 * s.dy[i],
                                 s.y[i] + 0.5 * s.dy[i], s.value[i])
                   : fmt::format("{} {} {} {}\n", s.x[i], s.y[i], s.dx[i], s.dy[i]);
      ++drawn;
      continue;
    }
    const double std = s.y_std.empty() || !std::isfinite(s.y_std[i]) ? 0.0 : s.y_std[i];
    out += fmt::format("{} {} {}\n", s.x[i], s.y[i], std);
    ++drawn;
  }
  return out + "END_OF_DATA\n";
}

// The point types of gnuplot: open and filled squares, discs, triangles, and so on.
constexpr struct { int open, filled; } kShapes[] = {{4, 5}, {6, 7}, {8, 9}, {12, 13}};

const char* colour_of(const PlotSeries& s, std::size_t index) {
  return kColours[s.look.value_or(index) % std::size(kColours)];
}

std::string style_of(const PlotSeries& s, std::size_t index) {
  const std::string colour = colour_of(s, index);
  const auto& shape = kShapes[s.look.value_or(1) % std::size(kShapes)];
  switch (s.style) {
    case PlotSeries::Style::kLine:
      return fmt::format("with lines lw 2 lc rgb '{}'", colour);
    case PlotSeries::Style::kDashedLine:
      return fmt::format("with lines lw 1.5 dt 2 lc rgb '{}'", colour);
    case PlotSeries::Style::kPoints:
      return fmt::format("with points pt {} ps {} lc rgb '{}'", shape.filled, s.look ? 1.2 : 0.8,
                         colour);
    case PlotSeries::Style::kOpenPoints:
      return fmt::format("with points pt {} ps 1.2 lc rgb '{}'", shape.open, colour);
    case PlotSeries::Style::kLineAndPoints:
      return fmt::format("with linespoints lw 2 pt 7 ps 0.8 lc rgb '{}'", colour);
    case PlotSeries::Style::kBoxes:
      return fmt::format("with boxes fs solid 0.35 border lc rgb '{}'", colour);
    case PlotSeries::Style::kArrows:
      return fmt::format("with vectors head filled size screen 0.012,20 lw 1.5 lc rgb '{}'",
                         colour);
    case PlotSeries::Style::kCells:
      return "with boxxyerror fs solid noborder fc palette";
  }
  throw std::invalid_argument("write_plot: no such style");
}

const char* columns_of(const PlotSeries& s) {
  if (s.style == PlotSeries::Style::kArrows) return "1:2:3:4";
  return s.style == PlotSeries::Style::kCells ? "1:2:3:4:5:6:7" : "1:2";
}

// Labels of a log scale, which gnuplot itself places at whole decades only.
std::string log_tics(double low, double high) {
  std::string list;
  for (double decade = std::pow(10.0, std::floor(std::log10(low))); decade <= high;
       decade *= 10.0) {
    for (const double step : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0}) {
      const double at = step * decade;
      if (at < low || at > high) continue;
      list += fmt::format("{}'{:g}' {}", list.empty() ? "" : ", ", at, at);
    }
  }
  return list;
}

// The diverging palette has the colours of the difference maps.
std::string colour_scale(const Plot& plot) {
  if (std::none_of(plot.series.begin(), plot.series.end(),
                   [](const PlotSeries& s) { return s.style == PlotSeries::Style::kCells; })) {
    return "";
  }
  // Close to viridis, whose lightness increases uniformly (van der Walt and Smith 2015).
  const PlotColours& colours = plot.colours;
  const std::string palette =
      colours.min ? "(0 '#440154', 1 '#3B528B', 2 '#21918C', 3 '#5EC962', 4 '#FDE725')"
                  : "(-1 '#2166AC', 0 '#FFFFFF', 1 '#B2182B')";
  return fmt::format(
      "set palette defined {}\n{}set cbrange [{}:{}]\n"
      "set cblabel {} noenhanced\n"
      "set object 1 rectangle from graph 0,0 to graph 1,1 behind fs solid noborder fc rgb "
      "'#C8C8C8'\nunset grid\n",
      palette,
      colours.min && colours.log
          ? "set logscale cb\nset cbtics (" + log_tics(*colours.min, colours.full_scale) + ")\n"
          : "",
      colours.min.value_or(-colours.full_scale), colours.full_scale, gnuplot_quoted(colours.label));
}

std::string script_of(const Plot& plot, const std::string& terminal) {
  std::string script = terminal;
  if (!plot.title.empty()) {
    script += fmt::format("set title {} noenhanced\n", gnuplot_quoted(plot.title));
  }
  script += axis("x", plot.x, false) + axis("y", plot.y, plot.y_down);
  script += "set grid lc rgb '#DDDDDD'\nset boxwidth 1.0 relative\n";
  script += colour_scale(plot);
  if (plot.equal_axes) script += "set size ratio -1\n";
  script += plot.legend_outside ? "set key outside right top Left reverse noenhanced\n"
            : plot.legend_above ? "set key outside top center horizontal noenhanced\n"
                                : "set key top right noenhanced\n";
  std::string curves;
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const std::size_t before = drawn;
    script += data_block(plot, i, drawn);
    if (drawn == before) continue;  // an empty block is an error for gnuplot
    const PlotSeries& s = plot.series[i];
    if (!curves.empty()) curves += ", ";
    // Error bars come first, as gnuplot blanks the area of their points.
    if (!s.y_std.empty()) {
      curves +=
          fmt::format("$series{} using 1:2:3 notitle with yerrorbars pt 7 ps 0.01 lc rgb '{}', ", i,
                      colour_of(s, i));
    }
    const std::string title = s.name.empty() ? "notitle" : "title " + gnuplot_quoted(s.name);
    curves += fmt::format("$series{} using {} {} {}", i, columns_of(s), title, style_of(s, i));
  }
  if (drawn == 0) throw std::invalid_argument("write_plot: nothing to draw: " + plot.title);
  return script + "plot " + curves + "\n";
}

std::string terminal_of(const Plot& plot, const std::string& extension) {
  const std::string size = fmt::format("size {},{}", plot.width_px, plot.height_px);
  if (extension == ".png") {
    return "set terminal pngcairo noenhanced " + size + " font 'sans,11'\n";
  }
  if (extension == ".svg") {
    return "set terminal svg noenhanced " + size + " font 'sans,14' background '#FFFFFF'\n";
  }
  throw std::invalid_argument("write_plot: .png or .svg expected, got '" + extension + "'");
}

// `name` is used in messages.
void draw(const std::string& script, const std::string& name, int descriptor) {
  const ChildResult child = run_child({"gnuplot", "-d"}, script, descriptor);
  if (child.status == ChildResult::kNotStarted) {
    throw InputError(name, "is not drawn: gnuplot cannot be started (" + child.errors +
                               "); install it (Debian: gnuplot-nox)");
  }
  const off_t size = ::lseek(descriptor, 0, SEEK_END);
  if (child.status != 0 || size <= 0) {
    throw InputError(name,
                     fmt::format("is not drawn: gnuplot ended with status {}, {} bytes drawn: {}",
                                 child.status, std::max<off_t>(size, 0), child.errors));
  }
}

}  // namespace

// Neither path nor data reach a shell or the command line of gnuplot: it reads the script from
// stdin and writes the picture to stdout, which is the pending file. -d ignores the user's
// ~/.gnuplot.
void write_plot(const Plot& plot, const std::string& path) {
  const std::filesystem::path file_path(path);
  const std::string script = script_of(plot, terminal_of(plot, file_path.extension().string()));
  capture::make_folder_of(path);
  capture::PendingFile file(path);
  draw(script, path, file.descriptor());
  file.commit();
}

std::string note_unless_drawn(const Plot& plot, const std::string& path) {
  try {
    write_plot(plot, path);
    return "";
  } catch (const InputError& error) {
    return std::string("note: ") + error.what() + "\n";
  }
}

}  // namespace scattermeter::apps
