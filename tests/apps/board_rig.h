// A rig with shots of a board that is drawn anew for each seed, to calibrate a camera with.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/random_stream.h"
#include "tests/apps/small_rig.h"

namespace scattermeter::apps {

// Boards seen by a camera of 484 x 324 samples, f = 520 px; one call of `random` per number.
inline std::string board_shots(const std::string& board, int count, double least_tilt,
                               double most_tilt, RandomStream* random) {
  std::ostringstream out;
  out << "calibration:\n  camera:\n    board: " << board << "\n    shots:\n";
  const auto between = [&](double a, double b) { return a + (b - a) * random->uniform(); };
  for (int i = 0; i < count; ++i) {
    const double azimuth = 2 * std::numbers::pi * (i + random->uniform()) / count;
    const double tilt = between(least_tilt, most_tilt);
    const double distance = between(330, 420);
    const double x = 120 + between(-30, 30);
    const double y = 90 + between(-25, 25);
    out << "      - {file: board_" << i << ".dng, position_mm: ["
        << x + distance * std::sin(tilt) * std::cos(azimuth) << ", "
        << y + distance * std::sin(tilt) * std::sin(azimuth) << ", " << distance * std::cos(tilt)
        << "], look_at_mm: [" << x << ", " << y << ", 0], up: [" << between(-0.3, 0.3)
        << ", 1, 0]}\n";
  }
  return out.str();
}

inline const char* const kChess = "{type: chessboard, squares: [8, 6], square_mm: 30}";
inline const char* const kCharuco =
    "{type: charuco, squares: [8, 6], square_mm: 30, marker_mm: 22, dictionary: DICT_4X4_50}";

struct BoardRig : SmallRig {
  BoardRig(const std::string& board, std::uint64_t seed, int count = 8, double least_tilt = 0.25,
           double most_tilt = 0.65) {
    RandomStream random(seed, 77);
    write(replaced(text(), "fx_px: 1229.5, fy_px: 1229.5, cx_px: 241.8, cy_px: 161.2",
                   "fx_px: 520, fy_px: 520, cx_px: 243.1, cy_px: 159.4, distortion: [-0.12, 0.05, "
                   "0, 0]") +
          board_shots(board, count, least_tilt, most_tilt, &random));
    std::filesystem::create_directories(shots());
  }
  std::string file() const { return *this / "camera.yaml"; }
  void shoot(int seed) const {
    const Answer a = run({"simulate", rig(), "--out", shots(), "--what", "calibration", "--seed",
                          std::to_string(seed), "-q"});
    if (a.status != 0) throw std::runtime_error(a.err);
  }
  Answer calibrate(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"calibrate", "camera", shots(), "--out", file()};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
};

}  // namespace scattermeter::apps
