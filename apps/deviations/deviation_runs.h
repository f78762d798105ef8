// Measuring the shots of deviating rigs with the rig that is stated.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/deviations/deviation.h"
#include "apps/deviations/deviation_verdict.h"
#include "apps/deviations/unit_pictures.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

// One rig and its shots. The three media (faint, plain, dense) are those of R, G and B.
struct DeviationRun {
  const Deviation* kind = nullptr;
  std::size_t size_idx = 0;
  std::string body;  // "cube", "pyramid", "sphere"
  int leds = 2;      // 1 or 2: a shot by each
  bool volume = false;
  std::uint64_t seed = 1;
  bool within() const { return static_cast<int>(size_idx) < kind->within; }
};

// The answer in one channel.
struct DeviationResult {
  DeviationRun run;
  std::size_t channel = 0;
  TrueCoefficients truth;
  Estimate estimate;  // with the reasons of a refusal
  JudgedAnswer judged;
  double seconds = 0;  // of the run, without the rendering
};

enum class DeviationRendering { kDipole, kVolume, kBoth };

struct DeviationOptions {
  // Runs, drawn evenly from the kinds and sizes; 0: each combination of kind, size, body, number of
  // LEDs and rendering once.
  int runs = 150;
  std::vector<std::string> kinds;   // names; empty: all
  std::vector<std::string> bodies;  // names; empty: all
  std::vector<int> sizes;           // indices of the kinds' sizes, from 0; empty: all
  int leds = 0;                     // 1 or 2; 0: both
  DeviationRendering rendering = DeviationRendering::kBoth;
  std::optional<std::uint64_t> run_seed = {};  // of every run, to repeat one; absent: drawn
  std::uint64_t seed = 1;
  int image_width_px = 484;
  // Of a volume rendering, for each light and channel.
  std::int64_t rendered_paths = 2'000'000;
  // Of measuring by transport, for each light and view.
  std::int64_t measured_paths = 5'000'000;
  double time_limit_s = 600;  // of measuring by transport, for each channel: paths end it before
  Progress* progress = nullptr;
  std::function<void(const DeviationResult&)> on_result = {};  // called for each as it comes
};

// Names of the media of R, G and B, and their coefficients.
struct DeviationMedium {
  const char* name;
  Medium medium;
};
const std::array<DeviationMedium, 3>& deviation_media();

// Throws std::invalid_argument for an unknown kind.
std::vector<DeviationRun> planned_runs(const DeviationOptions& options);

// The rig of a careful user, and its mesh: what measuring is told.
Rig stated_rig(const DeviationRun& run, int image_width_px);
TriangleMesh stated_mesh(const std::string& body);
// What is true without a deviation: the rig as stated, with the media of its truth.materials.
TrueSetup true_setup(const Rig& stated, const TriangleMesh& mesh);

// What is true of a rig that deviates, and what measuring reports of its shots for R, G and B; a
// rig that is refused as a whole gives three refusals.
struct MeasuredSetup {
  TrueSetup setup;
  std::array<Estimate, 3> estimates;
  double seconds = 0;  // of measuring, without the rendering
};
// Renders and measures the shots of a setup after it was made to deviate as run.kind says, by
// run.seed. Measuring is told the stated rig, and the mesh that the setup has before.
MeasuredSetup measure_deviating(Rig stated, TrueSetup setup, const DeviationRun& run,
                                const DeviationOptions& options, UnitPictures& pictures);

// Three results for each run, in their order.
std::vector<DeviationResult> bench_deviations(const DeviationOptions& options);

}  // namespace scattermeter::apps
