#include "apps/report/plot.h"

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

Plot example() {
  Plot plot;
  plot.title = "It's \"quoted\" `date` $HOME _sub\nsecond";
  plot.x = {"distance [mm]", true};
  plot.y = {"R [1/mm^2]", true};
  plot.series = {
      {"line", PlotSeries::Style::kLine, {1, 2, 4}, {1, 0.5, 0.1}},
      {"with 'errors'", PlotSeries::Style::kPoints, {1, 2, 4}, {1.1, 0.4, 0.1}, {0.1, 0.1, 0.05}},
      // Off the logarithmic axis, and no number.
      {"undrawn",
       PlotSeries::Style::kLine,
       {-1, 2},
       {1, std::numeric_limits<double>::quiet_NaN()}}};
  return plot;
}

TEST(Plot, DrawsPngAndSvg) {
  const TemporaryFolder folder;
  const std::string odd = folder / "it's a $(folder)/a b";
  write_plot(example(), odd + ".png");
  const std::string png = slurp(odd + ".png");
  EXPECT_THAT(png, StartsWith("\x89PNG"));
  EXPECT_GT(png.size(), 5000U);
  write_plot(example(), odd + ".svg");
  const std::string svg = slurp(odd + ".svg");
  EXPECT_THAT(svg, HasSubstr("<svg"));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, HasSubstr("distance [mm]"));
  EXPECT_THAT(svg, HasSubstr("`date` $HOME _sub second"));
  EXPECT_THAT(svg, ::testing::Not(HasSubstr("undrawn")));
  // Nothing else lies there.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "it's a $(folder)"), {}), 2);
}

// A look is a colour and a shape, wherever the series stands in the list.
TEST(Plot, Looks) {
  const TemporaryFolder folder;
  Plot plot;
  plot.legend_outside = true;
  plot.series = {{"filled", PlotSeries::Style::kPoints, {1, 2}, {3, 5}, {}, 2},
                 {"open", PlotSeries::Style::kOpenPoints, {1, 2}, {4, 6}, {}, 2},
                 {"dashed", PlotSeries::Style::kDashedLine, {1, 2}, {4, 4}, {}, 4}};
  write_plot(plot, folder / "looks.svg");
  const std::string svg = slurp(folder / "looks.svg");
  for (const char* text : {">filled<", ">open<", "#gpPt7' transform", "#gpPt8' transform",
                           "rgb(  0, 158, 115)", "rgb(230, 159,   0)' stroke-dasharray"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
  EXPECT_THAT(svg, ::testing::Not(HasSubstr("rgb(  0, 114, 178)")));  // the first colour
}

TEST(Plot, Boxes) {
  const TemporaryFolder folder;
  Plot plot;
  plot.series = {{"", PlotSeries::Style::kBoxes, {0, 1, 2}, {3, 5, 1}}};
  write_plot(plot, folder / "boxes.svg");
  EXPECT_THAT(slurp(folder / "boxes.svg"), HasSubstr("</svg>"));
}

std::string svg_of(const Plot& plot) {
  const TemporaryFolder folder;
  write_plot(plot, folder / "plot.svg");
  return slurp(folder / "plot.svg");
}

TEST(Plot, CellsHaveAColourEach) {
  Plot plot;
  PlotSeries cells{"", PlotSeries::Style::kCells, {0.5, 1.5, 2.5}, {0.5, 0.5, 0.5}};
  cells.dx = cells.dy = {1, 1, 1};
  cells.value = {-2, 2, std::numeric_limits<double>::quiet_NaN()};
  plot.series = {cells};
  plot.colours = {"it's [%]", 2};
  const std::string svg = svg_of(plot);
  // The ends of the scale, the ground where no cell is, the scale's label.
  for (const char* text :
       {"rgb( 33, 102, 172)", "rgb(178,  24,  43)", "rgb(200, 200, 200)", "it's [%]"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
  plot.series[0].value.pop_back();
  EXPECT_THROW(svg_of(plot), std::invalid_argument);
}

Plot log_cells() {
  Plot plot;
  PlotSeries cells{"", PlotSeries::Style::kCells, {0.5, 1.5}, {0.5, 0.5}};
  cells.dx = cells.dy = {1, 1};
  cells.value = {1.2, 9};
  plot.series = {cells};
  plot.colours = {"deviation [%]", 9, 1.2, true};
  plot.equal_axes = true;
  return plot;
}

// From dark blue to yellow, with labels inside a decade.
TEST(Plot, CellsOnALogScale) {
  const std::string svg = svg_of(log_cells());
  for (const char* text : {"rgb( 68,   1,  84)", "rgb(253, 231,  37)", ">1.5<", ">7<"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
}

TEST(Plot, RefusesWhatCannotBeDrawn) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_plot(example(), folder / "a.gif"), std::invalid_argument);
  EXPECT_THROW(write_plot({}, folder / "a.png"), std::invalid_argument);
  Plot uneven = example();
  uneven.series[0].y.pop_back();
  EXPECT_THROW(write_plot(uneven, folder / "a.png"), std::invalid_argument);
  EXPECT_EQ(folder.entries(), 0);
}

// A place without gnuplot.
TEST(Plot, MissingGnuplotIsNamed) {
  const TemporaryFolder folder;
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder.path().c_str(), 1);
  try {
    write_plot(example(), folder / "a.png");
    ADD_FAILURE() << "drawn without gnuplot";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("gnuplot-nox"));
    EXPECT_THAT(e.what(), HasSubstr("a.png"));
  }
  // One that fails says why.
  write_file(folder / "gnuplot", std::string("#!/bin/sh\necho 'no font' >&2\nexit 5\n"));
  std::filesystem::permissions(folder / "gnuplot", std::filesystem::perms::owner_all);
  try {
    write_plot(example(), folder / "a.png");
    ADD_FAILURE() << "drawn by a gnuplot that fails";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("status 5"));
    EXPECT_THAT(e.what(), HasSubstr("no font"));
  }
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(folder.entries(), 1);
}

}  // namespace
}  // namespace scattermeter::apps
