#include "calib/board/tone_picture.h"

#include <algorithm>
#include <cmath>

namespace scattermeter::calib {
namespace {

struct Range {
  float low = 0;
  float high = 0;
};

// Of many samples only every 37th is used: a prime, so that no row or mosaic pattern is in step.
Range robust_range(const std::vector<float>& image) {
  std::vector<float> sample;
  const size_t step = image.size() > 400000 ? 37 : 1;
  for (size_t i = 0; i < image.size(); i += step) {
    if (std::isfinite(image[i])) sample.push_back(image[i]);
  }
  if (sample.empty()) return {};
  const auto at = [&](double share) {
    const auto n = static_cast<double>(sample.size() - 1);
    const auto place = sample.begin() + static_cast<std::ptrdiff_t>(share * n);
    std::nth_element(sample.begin(), place, sample.end());
    return *place;
  };
  const float low = at(0.005);
  return {low, at(0.995)};
}

}  // namespace

cv::Mat_<float> stretched_image(const std::vector<float>& image, int width_px, int height_px) {
  const Range range = robust_range(image);
  if (!(range.high > range.low)) return {};
  cv::Mat_<float> stretched(height_px, width_px);
  std::transform(image.begin(), image.end(), stretched.begin(), [&](float v) {
    return std::isfinite(v) ? (v - range.low) / (range.high - range.low) : 0.0F;
  });
  return stretched;
}

float gamma_curve(float v) { return std::pow(v, 1 / 2.2F); }
float steep_curve(float v) { return std::log1p(1000 * v) / std::log1p(1000.0F); }

cv::Mat_<unsigned char> to_8_bit(const cv::Mat_<float>& stretched, float (*curve)(float)) {
  constexpr int kSteps = 4096;  // finer than what 8 bits show
  std::vector<unsigned char> table(kSteps + 1);
  for (int i = 0; i <= kSteps; ++i) {
    const float v = curve(static_cast<float>(i) / kSteps);
    table[static_cast<size_t>(i)] = cv::saturate_cast<unsigned char>(255 * v);
  }
  cv::Mat_<unsigned char> out(stretched.size());
  std::transform(stretched.begin(), stretched.end(), out.begin(), [&](float v) {
    const float clamped = std::clamp(v, 0.0F, 1.0F);
    return table[static_cast<size_t>(clamped * kSteps)];
  });
  return out;
}

}  // namespace scattermeter::calib
