// The estimate itself, without files: observed shots of a scene in, coefficients out.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/stopwatch.h"
#include "core/estimation/channel_result.h"
#include "core/scene/lit_objects.h"
#include "core/scene/observed_shot.h"
#include "core/scene/scene.h"

namespace scattermeter {

class Estimation;
struct KeptLight;

struct EstimateOptions {
  std::string model = "dipole";  // name of an estimator
  std::string channels;          // of "RGB", those that are estimated; empty: all
  // Transport: light paths of the last step for each light and view, at most. Where they run out
  // before the time does, the digits are the same on any machine.
  std::int64_t paths = 1'000'000'000;
  double time_limit_s = 50;    // transport: per material and channel
  bool keep_rows = false;      // fill ChannelResult::rows
  bool without_noise = false;  // the shots show what is expected, without the noise that they count
                               // with (dipole only)
};

// One way to estimate. A new one is a row of the table in estimate.cc and a file of its own.
struct Estimator {
  const char* name;         // as --model states it
  const char* description;  // half a sentence for help texts
  bool on_smooth_knots;     // works on KeptLight::weights, which may be made beforehand
  void (*estimate)(Estimation&);
};

std::span<const Estimator> estimators();
// Throws std::invalid_argument for a name that no estimator has.
const Estimator& estimator(const std::string& name);

// Materials in the scene's order, R G B each, from shots that refer to `scene` and `lit`. Same
// digits for any number of threads. Throws InputError where the shots of one material are of
// objects with different eta, std::invalid_argument for an unknown model, Cancelled.
std::vector<ChannelResult> estimate(const Scene& scene, LitObjects& lit,
                                    std::span<const ObservedShot> shots,
                                    const EstimateOptions& options = {},
                                    Progress* progress = nullptr);
// The same with light that was made for earlier shots of the same views, and with the time of each
// stage.
std::vector<ChannelResult> estimate(const Scene& scene, LitObjects& lit,
                                    std::span<const ObservedShot> shots,
                                    const EstimateOptions& options, KeptLight& kept,
                                    Stopwatch& watch, Progress* progress);

}  // namespace scattermeter
