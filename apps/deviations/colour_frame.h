// Expected counts of a frame in all three channels of each pixel.
#pragma once

#include <array>
#include <vector>

#include "core/camera/cfa_pattern.h"
#include "core/camera/pixel_rect.h"

namespace scattermeter::apps {

struct ColourFrame {
  int width_px = 0, height_px = 0;
  PixelRect object;                               // around the object
  std::array<std::vector<float>, 3> counts = {};  // R, G, B above black, row by row
  double range_counts = 0;                        // from black to the stated white level

  float& at(std::size_t channel, int x, int y) { return counts[channel][index(x, y)]; }
  float at(std::size_t channel, int x, int y) const { return counts[channel][index(x, y)]; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
           static_cast<std::size_t>(x);
  }
};

// A black frame.
ColourFrame black_frame(int width_px, int height_px, double range_counts);

// Multiplies every count of a channel.
void scale_channel(ColourFrame& frame, std::size_t channel, double factor);
void scale_frame(ColourFrame& frame, double factor);
double mean_counts(const ColourFrame& frame, std::size_t channel);
// Counts that this share of a channel's lit pixels exceeds, in the channel where it is largest; 0
// in a black frame. 0 <= share < 1.
double counts_exceeded(const ColourFrame& frame, double share);

// Convolves with a normal distribution of this standard deviation in both directions, or along the
// rows only. Beyond the frame it is black. Precondition: std_px > 0.
void blur(ColourFrame& frame, double std_px, bool rows_only = false);
// Mean over a horizontal path of this length, > 0.
void smear(ColourFrame& frame, double length_px);

// Multiplies the counts in a disc by `factor`, with an edge of one pixel. Coordinates are relative
// to the rectangle of the object: (0, 0) is its upper left corner, (1, 1) its lower right.
void multiply_disc(ColourFrame& frame, double x, double y, double radius_px, double factor);
// Adds counts in the same way.
void add_disc(ColourFrame& frame, double x, double y, double radius_px, double counts);

// Each pixel in the channel of its filter.
std::vector<float> mosaic(const ColourFrame& frame, const CfaPattern& cfa);

}  // namespace scattermeter::apps
