// A pyramid in the middle of a ChArUco board that gives each shot's pose, 968 x 648 samples.
#pragma once

#include <string>

#include "tests/apps/small_rig.h"

namespace scattermeter::apps {

// shots_holding: as SmallRig::keep_shots().
struct CharucoRig : SmallRig {
  explicit CharucoRig(const std::string& shots_holding) {
    keep_shots(shots_holding);
    const std::size_t begin = text().find("  points:");
    const std::size_t end = text().find("objects:");
    const std::string board =
        "  charuco: {squares: [10, 8], square_mm: 6, marker_mm: 4.5, dictionary: DICT_4X4_100, "
        "origin_mm: [-30, -22, 0]}\n";
    write(replaced(replaced(text().substr(0, begin) + board + text().substr(end), "[484, 324]",
                            "[968, 648]"),
                   "{fx_px: 1229.5, fy_px: 1229.5, cx_px: 241.8, cy_px: 161.2}",
                   "{fx_px: 2459, fy_px: 2459, cx_px: 483.6, cy_px: 322.4}") +
          "  pose: {position_mm: [0, -100, 150], look_at_mm: [0, 0, 9]}\n");
  }
};

}  // namespace scattermeter::apps
