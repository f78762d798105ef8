#include "apps/report/picture.h"

#include <algorithm>

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

}  // namespace scattermeter::apps
