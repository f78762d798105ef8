#include "apps/report/picture.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "capture/files/png.h"

namespace scattermeter::apps {
namespace {

constexpr int kLetters = cv::FONT_HERSHEY_SIMPLEX;

}  // namespace

Picture::Picture(int width, int height, PictureColour colour)
    : width_px(width),
      height_px(height),
      rgb(3U * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = colour[i % 3];
}

void Picture::set(int x, int y, PictureColour colour) {
  std::copy(colour.begin(), colour.end(), rgb.begin() + 3L * (static_cast<long>(y) * width_px + x));
}

PictureColour Picture::at(int x, int y) const {
  const auto i = 3U * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                       static_cast<std::size_t>(x));
  return {rgb[i], rgb[i + 1], rgb[i + 2]};
}

Picture side_by_side(const std::vector<Picture>& pictures, int gap_px) {
  int width = -gap_px;
  int height = 0;
  for (const Picture& p : pictures) {
    width += p.width_px + gap_px;
    height = std::max(height, p.height_px);
  }
  Picture out(std::max(width, 0), height, {255, 255, 255});
  int x0 = 0;
  for (const Picture& p : pictures) {
    for (int y = 0; y < p.height_px; ++y) {
      for (int x = 0; x < p.width_px; ++x) out.set(x0 + x, y, p.at(x, y));
    }
    x0 += p.width_px + gap_px;
  }
  return out;
}

void draw_text(Picture& picture, const std::string& text, int x, int y, int height_px) {
  cv::Mat rgb(picture.height_px, picture.width_px, CV_8UC3, picture.rgb.data());
  cv::putText(rgb, text, {x, y}, kLetters, cv::getFontScaleFromHeight(kLetters, height_px, 1),
              {30, 30, 30}, 1, cv::LINE_AA);
}

int text_width(const std::string& text, int height_px) {
  int baseline = 0;
  const double scale = cv::getFontScaleFromHeight(kLetters, height_px, 1);
  return cv::getTextSize(text, kLetters, scale, 1, &baseline).width;
}

std::string png_bytes(const Picture& picture) {
  const std::vector<std::uint8_t> bytes =
      capture::png_of_rgb(picture.width_px, picture.height_px, picture.rgb);
  return {bytes.begin(), bytes.end()};
}

PictureColour grey_colour(double value) {
  const auto g =
      static_cast<std::uint8_t>(std::lround(255.0 * std::sqrt(std::clamp(value, 0.0, 1.0))));
  return {g, g, g};
}

PictureColour difference_colour(double value) {
  constexpr std::array<double, 3> kBlue = {33, 102, 172};
  constexpr std::array<double, 3> kRed = {178, 24, 43};
  const double part = std::min(std::abs(value), 1.0);
  const auto& end = value < 0.0 ? kBlue : kRed;
  PictureColour out{};
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = static_cast<std::uint8_t>(std::lround(255.0 + part * (end[i] - 255.0)));
  }
  return out;
}

}  // namespace scattermeter::apps
