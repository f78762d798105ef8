// The joint model of a rig's shots, as `check` holds each of them against it.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "apps/instrument/measure.h"
#include "apps/instrument/open_shots.h"
#include "capture/shots/shot_source.h"
#include "core/base/progress.h"
#include "core/fit/linear_shot.h"
#include "core/fit/shot_departure.h"

namespace scattermeter::apps {

// A material in a channel.
struct CheckedTask {
  std::string material;
  std::size_t channel = 0;
  std::vector<std::size_t> shots;  // indices into the opened shots: those that are of use
  Estimate estimate;
  std::vector<ShotResult> singles;  // of the same shots, each alone; empty for a single shot
  // Where the joint model came to an end.
  std::optional<ShotDepartures> departures;
  std::vector<Nuisance> nuisances;  // of departures->nuisances
};

// How well lights and objects of the rig explain a shot: rms of what is left of the image over rms
// of the image, in any scale, for the best of a few media.
struct ShotLikeness {
  double own = std::numeric_limits<double>::quiet_NaN();  // as the rig lists it; NaN: of no use
  double best_other = std::numeric_limits<double>::infinity();
  std::string other;  // "lit by led2", "of object pyramid, lit by led1"
};

struct CheckFit {
  std::vector<CheckedTask> tasks;
  std::vector<ShotLikeness> likeness;  // by opened shot
};

// Runs the dipole on all shots of the source, opened for `rig` with `library` and `shared`; shots
// that are dark or clipped as a whole take no part.
CheckFit fit_for_check(const Rig& rig, const capture::ShotSource& source,
                       const std::vector<ObservedShot>& shots, LitObjects& library,
                       const std::optional<SharedView>& shared, Progress* progress);

}  // namespace scattermeter::apps
