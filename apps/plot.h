// Line and scatter plots as PNG or SVG.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace scattermeter::apps {

struct PlotAxis {
  std::string label;  // with its unit in brackets
  bool log = false;
  std::optional<double> min = std::nullopt;  // absent: chosen from the data
  std::optional<double> max = std::nullopt;
};

struct PlotSeries {
  enum class Style {
    kLine,
    kDashedLine,
    kPoints,
    kOpenPoints,
    kLineAndPoints,
    kBoxes,
    kArrows,
    kCells,
  };
  std::string name;  // in the legend; "": not there
  Style style = Style::kLine;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> y_std = {};  // error bars; empty: none. Not for boxes
  // Of eight colours; of open and filled points with it their shape, the same for both. Absent: the
  // colour of its place in the list, and discs.
  std::optional<std::size_t> look = std::nullopt;
  // Of arrows only, which lead from (x, y) to (x + dx, y + dy).
  std::vector<double> dx = {};
  std::vector<double> dy = {};
  // Of cells only: rectangles of width dx and height dy about (x, y), coloured by their value on
  // Plot::colours. What no cell covers is grey.
  std::vector<double> value = {};
};

// Blue for -full_scale through white to red for +full_scale (and beyond), as a scale beside the
// axes. With `min`: dark blue for min through green to yellow for full_scale.
struct PlotColours {
  std::string label;  // with its unit in brackets
  double full_scale = 1;
  std::optional<double> min = std::nullopt;
  bool log = false;  // with min, which is then > 0
};

struct Plot {
  std::string title;
  PlotAxis x;
  PlotAxis y;
  std::vector<PlotSeries> series;
  bool legend_outside = false;  // to the right of the axes; else in their upper right corner,
  bool legend_above = false;    // or in a line above the axes
  int width_px = 1000;
  int height_px = 640;
  bool y_down = false;       // as in a picture
  bool equal_axes = false;   // a unit of x as long as one of y
  PlotColours colours = {};  // of cells
};

// Draws the plot into `path`, whose ending says the format: .png or .svg. The folder is made where
// it is missing; the file appears complete or not at all. Points with a coordinate that is not
// finite (or not positive on a log axis) are left out. Text is taken as it is: no markup, any
// quotes; control characters become spaces. Throws std::invalid_argument for another ending, for
// lists of unequal length, or when nothing is left to draw; InputError when gnuplot, which draws,
// is not installed or fails, or when the file cannot be written.
void write_plot(const Plot& plot, const std::string& path);

// The same as the text of an SVG file.
std::string plot_svg(const Plot& plot);

// The same of many plots, by one start of gnuplot; throws as for the first that cannot be drawn.
std::vector<std::string> plot_svgs(const std::vector<Plot>& plots);

}  // namespace scattermeter::apps
