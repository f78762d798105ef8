// A shot in small, with what is left out marked.
#pragma once

#include "apps/picture.h"
#include "capture/raw_frame.h"
#include "core/observation.h"
#include "core/sample_map.h"

namespace scattermeter::apps {

// Colours of the marks, for the legend.
inline constexpr PictureColour kOutlineColour = {230, 159, 0};  // about the samples that are in use
inline constexpr PictureColour kClippedColour = {213, 0, 50};

// The map's rectangle and a tenth of it around, at most `width_px` wide, as grey light (black
// subtracted, brightest white, gamma 2); clipped pixels and the outlines of the places in use are
// marked.
Picture shot_picture(const capture::RawFrame& frame, const SampleMap& map, int width_px);

// Values on the rows of a map as a picture of its rectangle, at most `width_px` wide;
// `colour_of_row` gives each row's colour, `background` the rest.
template <class ColourOfRow>
Picture row_picture(const SampleMap& map, int width_px, PictureColour background,
                    const ColourOfRow& colour_of_row) {
  const int step = (map.width + width_px - 1) / width_px;
  Picture out(map.width / step, map.height / step, background);
  for (int y = 0; y < out.height_px; ++y) {
    for (int x = 0; x < out.width_px; ++x) {
      const auto at =
          static_cast<std::size_t>(y * step + step / 2) * static_cast<std::size_t>(map.width) +
          static_cast<std::size_t>(x * step + step / 2);
      const std::int32_t row = map.row_of_sample[at];
      if (row >= 0) out.set(x, y, colour_of_row(static_cast<std::size_t>(row)));
    }
  }
  return out;
}

}  // namespace scattermeter::apps
