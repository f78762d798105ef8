// The published experiment with silicones, on rigs with the errors of real ones.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/deviations/deviation_runs.h"
#include "apps/deviations/deviation_verdict.h"
#include "core/base/progress.h"
#include "core/material/medium.h"

namespace scattermeter::apps {

// Three silicones with white and coloured pigments, as in Hevisov, Foschum and Kienle (Photonics
// 2025, 12, 1118), who measured a cube and a bust of each from one image with a stated index and
// anisotropy, and compared with an integrating sphere. Reduced coefficients, R, G and B.
struct Silicone {
  const char* name;
  std::array<Medium, 3> media;
};
const std::array<Silicone, 3>& silicones();

// Every rig is drawn anew from what it states: LEDs 0.3 mm, marks 0.3 px, scale 2 %, mesh 0.1 mm
// and all else that is not exact by default; eta by 0.01, g evenly between 0 and 0.9 (the rig is
// silent about it), and the albedo of the table by 0.04 from 0.04, not below 0 (it is silent about
// the table, too).
struct SiliconeOptions {
  int draws = 1;  // of each silicone, body and number of images
  std::vector<std::string> bodies = {"cube", "bust"};  // bust: a scan-like body of 20k triangles
  std::vector<std::string> silicones;                  // names; empty: all
  std::vector<int> images = {1, 3};                    // 1 to 3, each under an LED of its own
  std::uint64_t seed = 1;
  int image_width_px = 484;
  std::int64_t rendered_paths = 4'000'000;  // for each light and channel
  std::int64_t measured_paths = 5'000'000;  // at most, for each light and view
  double time_limit_s = 600;                // for each channel: paths end it before
  Progress* progress = nullptr;
  std::function<void(const struct SiliconeResult&)> on_result = {};
};

struct SiliconeAnswer {
  Medium truth;
  Estimate estimate;
  JudgedAnswer judged;
};
struct SiliconeResult {
  std::string body, silicone;
  int images = 1;
  int draw = 0;
  std::array<SiliconeAnswer, 3> channel;
  // CIEDE2000 between pictures of the body under its first LED by the dipole, with the measured
  // coefficients and with the true ones, in the mean over the lit pixels; the brightest of the true
  // picture is white, and the channels count as linear sRGB. NaN unless all three are answered.
  double colour_difference = 0;
  double seconds = 0;  // of measuring
};

// Throws std::invalid_argument for an unknown body or silicone, or a number of images that is not 1
// to 3.
std::vector<SiliconeResult> bench_silicones(const SiliconeOptions& options);

}  // namespace scattermeter::apps
