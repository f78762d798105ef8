#include "apps/deviations/colour_frame.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include <oneapi/tbb/parallel_for.h>

namespace scattermeter::apps {
namespace {

// Convolves along rows (step 1) or columns (step width) with a symmetric kernel of odd length.
void convolve(std::vector<float>& plane, int lines, int length, std::size_t next_line,
              std::size_t step, const std::vector<double>& kernel) {
  const int reach = static_cast<int>(kernel.size()) / 2;
  tbb::parallel_for(0, lines, [&](int line) {
    const std::size_t start = static_cast<std::size_t>(line) * next_line;
    std::vector<float> old(static_cast<std::size_t>(length));
    for (int i = 0; i < length; ++i) {
      old[static_cast<std::size_t>(i)] = plane[start + static_cast<std::size_t>(i) * step];
    }
    for (int i = 0; i < length; ++i) {
      double sum = 0.0;
      for (int k = std::max(-reach, -i); k <= std::min(reach, length - 1 - i); ++k) {
        sum += kernel[static_cast<std::size_t>(k + reach)] *
               static_cast<double>(old[static_cast<std::size_t>(i + k)]);
      }
      plane[start + static_cast<std::size_t>(i) * step] = static_cast<float>(sum);
    }
  });
}

void normalise(std::vector<double>& kernel) {
  double sum = 0.0;
  for (double k : kernel) sum += k;
  for (double& k : kernel) k /= sum;
}

// Calls use(pixel index, share 0 .. 1 of the disc) for each pixel that the disc touches.
template <class Use>
void for_disc(const ColourFrame& frame, double x, double y, double radius_px, const Use& use) {
  const double cx = frame.object.x0 + x * frame.object.width;
  const double cy = frame.object.y0 + y * frame.object.height;
  const int reach = static_cast<int>(std::ceil(radius_px)) + 1;
  const int from_x = std::max(0, static_cast<int>(cx) - reach);
  const int from_y = std::max(0, static_cast<int>(cy) - reach);
  for (int v = from_y; v <= std::min(frame.height_px - 1, static_cast<int>(cy) + reach); ++v) {
    for (int u = from_x; u <= std::min(frame.width_px - 1, static_cast<int>(cx) + reach); ++u) {
      const double share = std::clamp(radius_px + 0.5 - std::hypot(u - cx, v - cy), 0.0, 1.0);
      if (share > 0.0) use(frame.index(u, v), share);
    }
  }
}

}  // namespace

ColourFrame black_frame(int width_px, int height_px, double range_counts) {
  ColourFrame frame{width_px, height_px, {}, {}, range_counts};
  for (std::vector<float>& plane : frame.counts) {
    plane.assign(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), 0.0F);
  }
  return frame;
}

void scale_channel(ColourFrame& frame, std::size_t channel, double factor) {
  for (float& c : frame.counts[channel]) c *= static_cast<float>(factor);
}

void scale_frame(ColourFrame& frame, double factor) {
  for (std::size_t c = 0; c < 3; ++c) scale_channel(frame, c, factor);
}

double mean_counts(const ColourFrame& frame, std::size_t channel) {
  double sum = 0.0;
  for (float c : frame.counts[channel]) sum += static_cast<double>(c);
  return sum / static_cast<double>(frame.counts[channel].size());
}

double counts_exceeded(const ColourFrame& frame, double share) {
  float most = 0.0F;
  for (const std::vector<float>& plane : frame.counts) {
    std::vector<float> lit;
    std::copy_if(plane.begin(), plane.end(), std::back_inserter(lit),
                 [](float counts) { return counts > 0.0F; });
    if (lit.empty()) continue;
    const auto above = static_cast<std::ptrdiff_t>(share * static_cast<double>(lit.size()));
    std::nth_element(lit.begin(), lit.begin() + above, lit.end(), std::greater<>());
    most = std::max(most, lit[static_cast<std::size_t>(above)]);
  }
  return static_cast<double>(most);
}

void blur(ColourFrame& frame, double std_px, bool rows_only) {
  const int reach = static_cast<int>(std::ceil(4.0 * std_px));
  std::vector<double> kernel;
  for (int k = -reach; k <= reach; ++k) kernel.push_back(std::exp(-0.5 * k * k / std_px / std_px));
  normalise(kernel);
  const auto width = static_cast<std::size_t>(frame.width_px);
  for (std::vector<float>& plane : frame.counts) {
    convolve(plane, frame.height_px, frame.width_px, width, 1, kernel);
    if (!rows_only) convolve(plane, frame.width_px, frame.height_px, 1, width, kernel);
  }
}

void smear(ColourFrame& frame, double length_px) {
  const int reach = static_cast<int>(std::ceil(0.5 * length_px)) + 1;
  std::vector<double> kernel(static_cast<std::size_t>(2 * reach + 1));
  constexpr int kSteps = 1000;
  for (int s = 0; s < kSteps; ++s) {  // linear between the pixels at each step of the path
    const double at = reach + length_px * ((s + 0.5) / kSteps - 0.5);
    const auto below = static_cast<std::size_t>(at);
    kernel[below] += 1.0 - (at - std::floor(at));
    kernel[below + 1] += at - std::floor(at);
  }
  normalise(kernel);
  for (std::vector<float>& plane : frame.counts) {
    convolve(plane, frame.height_px, frame.width_px, static_cast<std::size_t>(frame.width_px), 1,
             kernel);
  }
}

void multiply_disc(ColourFrame& frame, double x, double y, double radius_px, double factor) {
  for_disc(frame, x, y, radius_px, [&](std::size_t i, double share) {
    for (std::vector<float>& plane : frame.counts) {
      plane[i] *= static_cast<float>(1.0 + share * (factor - 1.0));
    }
  });
}

void add_disc(ColourFrame& frame, double x, double y, double radius_px, double counts) {
  for_disc(frame, x, y, radius_px, [&](std::size_t i, double share) {
    for (std::vector<float>& plane : frame.counts) plane[i] += static_cast<float>(share * counts);
  });
}

std::vector<float> mosaic(const ColourFrame& frame, const CfaPattern& cfa) {
  std::vector<float> out(frame.counts[0].size());
  for (int y = 0; y < frame.height_px; ++y) {
    for (int x = 0; x < frame.width_px; ++x) {
      const std::size_t i = frame.index(x, y);
      out[i] = frame.counts[static_cast<std::size_t>(cfa.at(x, y))][i];
    }
  }
  return out;
}

}  // namespace scattermeter::apps
