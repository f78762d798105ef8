// The joint model of a rig's shots with which `check` compares each of them.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "apps/checking/image_causes.h"
#include "apps/instrument/measure.h"
#include "apps/instrument/seen_shots.h"
#include "apps/looks/finding.h"
#include "apps/looks/light_look.h"
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
  std::string model;               // "dipole" or "transport"
  Estimate estimate;
  std::vector<ShotResult> singles;  // of the same shots, each alone; empty for a single shot
  // Present if the joint fit converged.
  std::optional<ShotDepartures> departures;
  std::vector<Nuisance> nuisances;  // of departures->nuisances
  std::vector<ImageCause> causes;   // of the image's departures; the best first
  // rms of the residual in patches beside the mesh's edges over that of the others, both relative
  // to l; 0 if unknown.
  double edge_excess = 0;
};

struct CheckFit {
  std::vector<CheckedChannel> channels;
  std::vector<ShotLikeness> likeness;  // by opened shot
  std::vector<Finding> findings;       // of the light (apps/looks/light_look.h)
};

// Fits the material to all shots of the source by the model that would measure it (the dipole where
// the shots show that it holds, else transport in one channel of the material), which are open for
// `rig` with `lit`; entirely dark or clipped shots are left out. Opens them again from where the
// fit shows the objects to be seen, as `measure` does (apps/instrument/fitted_view.h). stated: the
// scene before the positions of its LEDs were loosened for `rig`. looks: what is wrong with which
// shots by the looks before; their channels are not searched by transport.
CheckFit fit_for_check(const Scene& stated, const Rig& rig, const capture::ShotSource& source,
                       SeenShots& seen, const std::vector<Finding>& looks, LitObjects& lit,
                       Progress* progress);

}  // namespace scattermeter::apps
