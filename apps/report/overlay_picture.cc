#include "apps/report/overlay_picture.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "calib/board/opencv_quiet.h"
#include "capture/files/png.h"
#include "core/base/input_error.h"
#include "core/mesh/visible_edges.h"

namespace scattermeter::apps {
namespace {

constexpr int kFractionBits = 4;  // of OpenCV's fixed-point coordinates

// The mean above black of each 2 x 2 cell in the rectangle of cells.
cv::Mat1f cells(const capture::RawFrame& frame, const cv::Rect& part) {
  double black = 0.0;
  for (double b : frame.black_counts) black += 0.25 * b;
  cv::Mat1f grey(part.height, part.width);
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) {
      const int fx = 2 * (part.x + x);
      const int fy = 2 * (part.y + y);
      const int sum =
          frame.at(fx, fy) + frame.at(fx + 1, fy) + frame.at(fx, fy + 1) + frame.at(fx + 1, fy + 1);
      grey(y, x) = static_cast<float>(std::max(0.0, 0.25 * sum - black));
    }
  }
  return grey;
}

float quantile(const cv::Mat1f& grey, double share) {
  std::vector<float> all(grey.begin(), grey.end());
  const auto at =
      all.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(all.size() - 1));
  std::nth_element(all.begin(), at, all.end());
  return *at;
}

}  // namespace

std::vector<OverlayLine> edge_lines(const CameraView& view, const RayScene& scene,
                                    const OverlayColours& colours) {
  VisibleEdgesOptions options;
  options.step_rad = 12.0 / view.intrinsics.fx_px;
  std::vector<OverlayLine> lines;
  for (const EdgePiece& piece : visible_edges(scene, view.center_in_world_mm(), options)) {
    const auto ends = project(view.intrinsics, view.camera_from_world,
                              {piece.center_mm - piece.half_mm, piece.center_mm + piece.half_mm});
    if (!ends[0].allFinite() || !ends[1].allFinite()) continue;
    const Rgb8& colour = piece.kind == EdgeKind::kContour ? colours.contour
                         : piece.kind == EdgeKind::kStep  ? colours.step
                                                          : colours.crease;
    lines.push_back({ends[0], ends[1], colour});
  }
  return lines;
}

std::vector<std::uint8_t> overlay_png(const capture::RawFrame& frame,
                                      const std::vector<OverlayLine>& lines,
                                      const std::vector<OverlayDot>& dots,
                                      const OverlayOptions& options) {
  const calib::OpencvQuiet quiet;
  const cv::Rect whole(0, 0, frame.width_px / 2, frame.height_px / 2);
  if (whole.empty() || options.max_width_px < 16) {
    throw std::invalid_argument("overlay_png: no frame, or a picture below 16 px");
  }
  cv::Rect part = whole;
  if (options.crop.x1 > options.crop.x0 && options.crop.y1 > options.crop.y0) {
    const int x0 = static_cast<int>(std::floor(options.crop.x0 / 2));
    const int y0 = static_cast<int>(std::floor(options.crop.y0 / 2));
    part = cv::Rect(x0, y0, static_cast<int>(std::ceil(options.crop.x1 / 2)) - x0,
                    static_cast<int>(std::ceil(options.crop.y1 / 2)) - y0) &
           whole;
    if (part.empty()) part = whole;
  }
  cv::Mat1f grey = cells(frame, part);
  // Picture pixels per cell.
  const int larger = std::clamp(options.max_width_px / part.width, 1, 8);
  const double scale = part.width > options.max_width_px
                           ? static_cast<double>(options.max_width_px) / part.width
                           : larger;
  const float top = std::max(1.0F, quantile(grey, 0.999));
  grey = cv::min(grey / top, 1.0);
  cv::Mat1f shown;
  cv::resize(grey, shown, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_NEAREST);
  cv::pow(shown, 1.0 / options.gamma, shown);
  cv::Mat1b byte;
  shown.convertTo(byte, CV_8U, 255.0);
  cv::Mat3b picture;
  cv::cvtColor(byte, picture, cv::COLOR_GRAY2BGR);
  // The centre of sample (0, 0) is half a sample from the corner of its cell; OpenCV's origin is
  // the centre of the first pixel of the picture.
  const auto at = [&](const Eigen::Vector2d& px) {
    const double x = ((px.x() + 0.5) / 2 - part.x) * scale - 0.5;
    const double y = ((px.y() + 0.5) / 2 - part.y) * scale - 0.5;
    constexpr double kFar = 1e5;
    return cv::Point(
        static_cast<int>(std::lround(std::clamp(x, -kFar, kFar) * (1 << kFractionBits))),
        static_cast<int>(std::lround(std::clamp(y, -kFar, kFar) * (1 << kFractionBits))));
  };
  const auto bgr = [](const Rgb8& c) { return cv::Scalar(c[2], c[1], c[0]); };
  for (const OverlayLine& line : lines) {
    if (!line.from_px.allFinite() || !line.to_px.allFinite()) continue;
    cv::line(picture, at(line.from_px), at(line.to_px), bgr(line.colour),
             std::max(1, static_cast<int>(std::lround(line.width_px))), cv::LINE_AA, kFractionBits);
  }
  for (const OverlayDot& dot : dots) {
    if (!dot.at_px.allFinite()) continue;
    cv::circle(picture, at(dot.at_px),
               static_cast<int>(std::lround(dot.radius_px * (1 << kFractionBits))), bgr(dot.colour),
               cv::FILLED, cv::LINE_AA, kFractionBits);
  }
  cv::cvtColor(picture, picture, cv::COLOR_BGR2RGB);
  return capture::png_of_rgb(picture.cols, picture.rows, {picture.data, 3 * picture.total()});
}

ImageRect crop_around(const std::vector<OverlayLine>& lines, int width_px, int height_px) {
  ImageRect r{1e30, 1e30, -1e30, -1e30};
  for (const OverlayLine& line : lines) {
    for (const Eigen::Vector2d& p : {line.from_px, line.to_px}) {
      if (!p.allFinite()) continue;
      r = {std::min(r.x0, p.x()), std::min(r.y0, p.y()), std::max(r.x1, p.x()),
           std::max(r.y1, p.y())};
    }
  }
  if (r.x1 < r.x0) return {0, 0, static_cast<double>(width_px), static_cast<double>(height_px)};
  const double margin = 0.1 * std::max(r.x1 - r.x0, r.y1 - r.y0) + 2;
  return {std::max(0.0, r.x0 - margin), std::max(0.0, r.y0 - margin),
          std::min<double>(width_px, r.x1 + margin), std::min<double>(height_px, r.y1 + margin)};
}

}  // namespace scattermeter::apps
