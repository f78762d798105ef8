// The joint model of a rig's shots with which `check` compares each of them.
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
struct CheckedChannel {
  std::string material;
  std::size_t channel = 0;
  std::vector<std::size_t> shots;  // indices into the opened shots, without unusable ones
  Estimate estimate;
  std::vector<ShotResult> singles;  // of the same shots, each alone; empty for a single shot
  // Present if the joint fit converged.
  std::optional<ShotDepartures> departures;
  std::vector<Nuisance> nuisances;  // of departures->nuisances
};

// How well lights and objects of the rig explain a shot: rms of the residual over rms of the image,
// with a free scale, for the best of a few media.
struct ShotLikeness {
  double own =
      std::numeric_limits<double>::quiet_NaN();  // as listed in the rig; NaN: the shot is unusable
  double best_other = std::numeric_limits<double>::infinity();
  std::string other;  // "lit by led2", "of object pyramid, lit by led1"
};

struct CheckFit {
  std::vector<CheckedChannel> channels;
  std::vector<ShotLikeness> likeness;  // by opened shot
};

// Fits the dipole to all shots of the source, which were opened for `rig` with `lit` and `shared`;
// entirely dark or clipped shots are left out.
CheckFit fit_for_check(const Rig& rig, const capture::ShotSource& source,
                       const std::vector<ObservedShot>& shots, LitObjects& lit,
                       const std::optional<SharedView>& shared, Progress* progress);

}  // namespace scattermeter::apps
