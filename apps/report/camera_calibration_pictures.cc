#include "apps/report/camera_calibration_pictures.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace scattermeter::apps {
namespace {

Plot frame_plot(const calib::CameraCalibration& c) {
  const double width = c.intrinsics.width_px;
  const double height = c.intrinsics.height_px;
  Plot plot;
  plot.x = {"x [px]", false, -0.5, width - 0.5};
  plot.y = {"y [px]", false, -0.5, height - 0.5};
  plot.y_down = true;
  plot.legend_outside = true;
  // The axes have about the aspect ratio of the frame, apart from margins and legend.
  plot.width_px = 1160;
  plot.height_px = static_cast<int>(std::lround(90 + 860 * height / width));
  return plot;
}

PlotSeries left_out_corners(const calib::CameraCalibration& c) {
  PlotSeries series;
  series.name = "left out";
  series.style = PlotSeries::Style::kOpenPoints;
  series.look = 1;
  for (const calib::LeftOutCorner& corner : c.corners_left_out) {
    series.x.push_back(corner.image_px.x());
    series.y.push_back(corner.image_px.y());
  }
  return series;
}

// The largest 1, 2 or 5 times a power of ten that is at most `value`.
double round_factor(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)));
  return (value >= 5 * unit ? 5 : value >= 2 * unit ? 2 : 1) * unit;
}

}  // namespace

Plot camera_residual_plot(const calib::CameraCalibration& c) {
  Plot plot = frame_plot(c);
  const double longest = std::max(1e-9, c.worst_px);
  const double factor = round_factor(c.intrinsics.width_px / 12.0 / longest);
  plot.title =
      fmt::format("Residuals x {:g}: rms {:.3f} px, worst {:.3f} px", factor, c.rms_px, c.worst_px);
  PlotSeries corners;
  corners.name = "corner";
  corners.style = PlotSeries::Style::kArrows;
  corners.look = 0;
  for (const calib::CornerResidual& r : c.residuals) {
    corners.x.push_back(r.image_px.x());
    corners.y.push_back(r.image_px.y());
    corners.dx.push_back(factor * r.residual_px.x());
    corners.dy.push_back(factor * r.residual_px.y());
  }
  plot.series = {corners, left_out_corners(c)};
  return plot;
}

Plot camera_coverage_plot(const calib::CameraCalibration& c) {
  Plot plot = frame_plot(c);
  plot.title = fmt::format("Corners in {} views: {:.0f} % of 5 x 5 fields of the frame covered",
                           c.views.size(), 100 * c.layout.covered_share);
  for (std::size_t v = 0; v < c.views.size(); ++v) {
    PlotSeries series;
    series.name = c.views[v].name;
    series.style = (v / 8) % 2 == 0 ? PlotSeries::Style::kPoints : PlotSeries::Style::kOpenPoints;
    series.look = v % 8;
    for (const calib::CornerResidual& r : c.residuals) {
      if (r.view_idx != v) continue;
      series.x.push_back(r.image_px.x());
      series.y.push_back(r.image_px.y());
    }
    plot.series.push_back(series);
  }
  plot.series.push_back(left_out_corners(c));
  return plot;
}

}  // namespace scattermeter::apps
