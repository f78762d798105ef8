// Line and scatter plots as PNG or SVG, the door to gnuplot.
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
  std::string name;  // in the legend; "" for none
  Style style = Style::kLine;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> y_std = {};  // error bars, not for boxes; empty for none
  // One of eight colours and, for points, shapes, the same for open and filled ones. Absent: the
  // colour by the index of the series, and discs.
  std::optional<std::size_t> look = std::nullopt;
  // For arrows only, from (x, y) to (x + dx, y + dy).
  std::vector<double> dx = {};
  std::vector<double> dy = {};
  // For cells only: rectangles of width dx and height dy centred on (x, y), coloured by their value
  // on the scale Plot::colours. The area without cells is grey.
  std::vector<double> value = {};
};

// The colour scale of cells, drawn beside the axes: from blue at -full_scale through white to red
// at +full_scale or, with `min`, from dark blue at min through green to yellow at full_scale.
// Values beyond are clamped.
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
  bool legend_outside = false;  // to the right of the axes
  bool legend_above = false;    // in a line above the axes; default: in their upper right corner
  int width_px = 1000;
  int height_px = 640;
  bool y_down = false;       // y increases downwards, as in a picture
  bool equal_axes = false;   // equal scales of x and y
  PlotColours colours = {};  // of cells
};

// Draws the plot to the file `path` in the format of its extension, .png or .svg. A missing folder
// is created; the file appears complete or not at all. Points with a coordinate that is not finite
// (or not positive on a log axis) are omitted. Text is literal, without markup; control characters
// become spaces. Throws std::invalid_argument for another extension, for lists of unequal length,
// or when there is nothing to draw; InputError when gnuplot is not installed or fails, or when the
// file cannot be written.
void write_plot(const Plot& plot, const std::string& path);

// For plots beside a result that is valid without them: the InputError of write_plot() as a line
// for the user, "note: ...\n"; "" if there is none.
std::string note_unless_drawn(const Plot& plot, const std::string& path);

}  // namespace scattermeter::apps
