// 8-bit pictures for OpenCV's detectors. For the .cc files of calib only, as it exposes OpenCV's
// types.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace scattermeter::calib {

// The image with its percentiles 0.5 and 99.5 mapped to 0 and 1 (so that a few hot or clipped
// samples do not determine the scale); values that are not finite become 0. Empty if the two
// percentiles are equal. Precondition: width_px * height_px samples.
cv::Mat_<float> stretched_image(const std::vector<float>& image, int width_px, int height_px);

// Tone curves on [0, 1]. Detection compares each pixel with its neighbourhood by a fixed number of
// grey levels, so the contrast must be about the same in shadow and light. The display gamma is
// suited to an evenly lit board, the steep curve to a board in the shade next to something
// brighter.
float gamma_curve(float v);
float steep_curve(float v);

// 255 * curve(value) for each value of a stretched image.
cv::Mat_<unsigned char> to_8_bit(const cv::Mat_<float>& stretched, float (*curve)(float));

}  // namespace scattermeter::calib
