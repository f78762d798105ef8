// Estimation of scattering coefficients from observed shots of a scene, without files.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
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
  std::string channels;          // the channels to estimate, of "RGB"; empty: all
  // Transport: maximum number of light paths of the last step for each light and view. If this
  // limit is reached before the time limit, the digits are the same on any machine.
  std::int64_t paths = 1'000'000'000;
  // Transport: trace at most so many for now; ChannelResult::has_enough_paths tells whether the
  // whole number would tell more.
  std::optional<std::int64_t> looking_paths = {};
  double time_limit_s = 20;  // transport: per material and channel
  bool keep_rows = false;    // fill ChannelResult::rows
  // Transport: called with the dipole's results, which say why transport is wanted, before it
  // begins; false ends the estimation there.
  std::function<bool(const std::vector<ChannelResult>&)> goes_on_from_dipole = {};
  // Transport: what an earlier estimation of the same shots found, to start from.
  std::vector<ChannelResult> found = {};
  // Rows that the shots have, over those that are given (core/view/chosen_rows.h); at least 1.
  double all_rows = 1;
  bool without_noise = false;  // shots are noise-free expected values (dipole only)
};

// One method of estimation. To add one, add a row to the table in estimate.cc and a file.
struct Estimator {
  const char* name;         // value of --model
  const char* description;  // a phrase for help texts
  bool on_smooth_knots;     // uses KeptLight::weights, which may be computed beforehand
  void (*estimate)(Estimation&);
};

std::span<const Estimator> estimators();
// Throws std::invalid_argument for an unknown name.
const Estimator& estimator(const std::string& name);

// Fills in the results' estimates, and refuses those of channels that contradict the rig together.
void run(const Estimator& chosen, Estimation& estimation);

// Returns the materials in the scene's order, R G B each. The shots must refer to `scene` and
// `lit`. The same digits for any number of threads. Throws InputError if the shots of one material
// show objects with different eta, std::invalid_argument for an unknown model, Cancelled.
std::vector<ChannelResult> estimate(const Scene& scene, LitObjects& lit,
                                    std::span<const ObservedShot> shots,
                                    const EstimateOptions& options = {},
                                    Progress* progress = nullptr);
// The same, reusing light computed for earlier shots of the same views, and recording the time of
// each stage.
std::vector<ChannelResult> estimate(const Scene& scene, LitObjects& lit,
                                    std::span<const ObservedShot> shots,
                                    const EstimateOptions& options, KeptLight& kept,
                                    Stopwatch& watch, Progress* progress);

}  // namespace scattermeter
