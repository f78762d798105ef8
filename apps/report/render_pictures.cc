#include "apps/report/render_pictures.h"

#include <algorithm>
#include <cmath>

namespace scattermeter::apps {
namespace {

constexpr int kGapPx = 8;
constexpr int kLetterPx = 12;
constexpr int kLinePx = 22;
constexpr PictureColour kSheetColour = {236, 236, 236};

// The mean of a block of pixels in linear light, for a reduced picture.
ColourRadiance shrunk(const ColourRadiance& from, int step) {
  if (step <= 1) return from;
  ColourRadiance out;
  out.width = (from.width + step - 1) / step;
  out.height = (from.height + step - 1) / step;
  out.rgb.resize(3U * static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (int yy = y * step; yy < std::min((y + 1) * step, from.height); ++yy) {
          for (int xx = x * step; xx < std::min((x + 1) * step, from.width); ++xx) {
            sum += from.rgb[static_cast<std::size_t>(3 * (yy * from.width + xx) + c)];
          }
        }
        // Pixels beyond the edge are dark.
        out.rgb[static_cast<std::size_t>(3 * (y * out.width + x) + c)] =
            static_cast<float>(sum / (step * step));
      }
    }
  }
  return out;
}

void paste(const Picture& from, Picture& to, int x0, int y0) {
  for (int y = 0; y < from.height_px; ++y) {
    for (int x = 0; x < from.width_px; ++x) to.set(x0 + x, y0 + y, from.at(x, y));
  }
}

// The text is truncated where it would extend into the next column.
void draw_label(Picture& sheet, std::string text, int x, int y, int width_px) {
  while (!text.empty() && text_width(text, kLetterPx) > width_px) text.pop_back();
  draw_text(sheet, text, x, y, kLetterPx);
}

}  // namespace

double white_radiance(const Rendering& rendering) {
  std::vector<float> lit;
  for (const RenderedPicture& p : rendering.pictures) {
    const std::vector<float>& rgb = p.radiance.rgb;
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
      const float most = std::max({rgb[i], rgb[i + 1], rgb[i + 2]});
      if (most > 0.0F) lit.push_back(most);
    }
  }
  if (lit.empty()) return 1.0;
  const auto place = lit.end() - 1 - static_cast<std::ptrdiff_t>(lit.size() / 500);
  std::nth_element(lit.begin(), place, lit.end());
  return *place;
}

std::uint8_t srgb_byte(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

Picture srgb_picture(const ColourRadiance& radiance, double white) {
  Picture out(radiance.width, radiance.height, {0, 0, 0});
  for (std::size_t i = 0; i < out.rgb.size(); ++i) out.rgb[i] = srgb_byte(radiance.rgb[i] / white);
  return out;
}

Picture contact_sheet(const Rendering& rendering, const std::vector<std::string>& materials,
                      double white, int max_width_px) {
  int width = 1;
  std::vector<int> heights(rendering.scenes.size(), 1);
  const int columns = static_cast<int>(materials.size());
  for (const RenderedPicture& p : rendering.pictures) width = std::max(width, p.radiance.width);
  const int room = std::max(80, (max_width_px - kGapPx) / columns - kGapPx);
  const int step = (width + room - 1) / room;
  const int cell = (width + step - 1) / step;
  for (const RenderedPicture& p : rendering.pictures) {
    heights[p.scene_idx] = std::max(heights[p.scene_idx], (p.radiance.height + step - 1) / step);
  }
  std::vector<int> tops;
  int y = kGapPx + kLinePx;
  for (int h : heights) {
    tops.push_back(y);
    y += h + kLinePx + kGapPx;
  }
  Picture sheet(kGapPx + columns * (cell + kGapPx), y, kSheetColour);
  for (int c = 0; c < columns; ++c) {
    draw_label(sheet, materials[static_cast<std::size_t>(c)], kGapPx + c * (cell + kGapPx), kLinePx,
               cell);
  }
  for (const RenderedPicture& p : rendering.pictures) {
    const Picture picture = srgb_picture(shrunk(p.radiance, step), white);
    const int left = kGapPx + static_cast<int>(p.material_idx) * (cell + kGapPx);
    paste(Picture(cell, heights[p.scene_idx], {0, 0, 0}), sheet, left, tops[p.scene_idx]);
    paste(picture, sheet, left + (cell - picture.width_px) / 2,
          tops[p.scene_idx] + (heights[p.scene_idx] - picture.height_px) / 2);
  }
  for (std::size_t s = 0; s < rendering.scenes.size(); ++s) {
    std::string text = rendering.scenes[s].object + ", ";
    for (const std::string& light : rendering.scenes[s].lights) {
      text += (text.ends_with(", ") ? "" : " + ") + light;
    }
    draw_label(sheet, text, kGapPx, tops[s] + heights[s] + kLinePx - 5,
               sheet.width_px - 2 * kGapPx);
  }
  return sheet;
}

}  // namespace scattermeter::apps
