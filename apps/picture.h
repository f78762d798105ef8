// A small colour picture for a page.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace scattermeter::apps {

using PictureColour = std::array<std::uint8_t, 3>;  // R, G, B as a screen takes them

struct Picture {
  Picture(int width, int height, PictureColour colour);
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;  // row by row, 3 bytes a pixel
  void set(int x, int y, PictureColour colour);
  PictureColour at(int x, int y) const;
};

// One beside the other on a common background, `gap_px` apart.
Picture side_by_side(const std::vector<Picture>& pictures, int gap_px);

// Dark letters whose capitals are `height_px` high, their baseline at y and their first at x.
// ASCII; anything else appears as question marks.
void draw_text(Picture& picture, const std::string& text, int x, int y, int height_px);
// Width of that text, px.
int text_width(const std::string& text, int height_px);

// A PNG file's bytes. Throws std::invalid_argument for an empty picture.
std::string png_bytes(const Picture& picture);

// Grey for 0 .. 1 (cut), with a gamma of 2 as raw light is too dark for a screen.
PictureColour grey_colour(double value);
// Blue for -1, white for 0, red for 1 (cut): Moreland's diverging idea with straight ends.
PictureColour difference_colour(double value);

}  // namespace scattermeter::apps
