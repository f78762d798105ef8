// Small colour pictures for an HTML page.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace scattermeter::apps {

using PictureColour = std::array<std::uint8_t, 3>;  // R, G, B in sRGB

struct Picture {
  Picture(int width, int height, PictureColour colour);
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;  // row by row, 3 bytes per pixel
  void set(int x, int y, PictureColour colour);
  PictureColour at(int x, int y) const;
};

// Draws ASCII text in dark letters with capitals `height_px` high, from x on with the baseline at
// y. Other characters appear as question marks.
void draw_text(Picture& picture, const std::string& text, int x, int y, int height_px);
// Width of this text in px.
int text_width(const std::string& text, int height_px);

// The bytes of a PNG file. Throws std::invalid_argument for an empty picture.
std::string png_bytes(const Picture& picture);

}  // namespace scattermeter::apps
