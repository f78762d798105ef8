// A rig made ready to measure: geometry, light and weights are computed once and serve many sets of
// shots.
#pragma once

#include <optional>
#include <vector>

#include "apps/instrument/measure.h"
#include "apps/rig/rig.h"
#include "capture/shots/shot_source.h"
#include "core/base/progress.h"
#include "core/base/stopwatch.h"
#include "core/estimation/estimation.h"
#include "core/scene/lit_objects.h"
#include "core/scene/observed_shot.h"
#include "core/scene/seen_object.h"

namespace scattermeter::apps {

class Instrument {
 public:
  // Rig and scenes must outlive it; the scenes may have been opened for another rig that has the
  // same objects. Throws InputError for a pose that the rig's points do not give, an object out of
  // view, or patches too small.
  Instrument(const Rig& rig, const ObjectScenes& objects, const MeasureOptions& options,
             Progress* progress = nullptr);
  Instrument(const Instrument&) = delete;
  Instrument& operator=(const Instrument&) = delete;

  // Measures the materials in these shots, jointly over the shots of each. The light in each patch
  // (W of every view and lamp) is computed when first needed and kept, as long as the pose comes
  // from the rig's points alone; with a board or silhouettes each set is seen anew. The digits are
  // the same either way. Results, patch sizes and timing are filled; notes and inputs are the
  // caller's. Throws InputError as measure() does. Not for several threads at once (it uses all of
  // them).
  Measurement measure(const capture::ShotSource& source);
  Measurement measure(const capture::ShotSource& source,
                      Stopwatch& watch);  // timing goes there only
  // Measures shots that show what is expected, without the noise that they count with, by the
  // dipole: what is stated is to be expected of shots with that noise. opened: these shots, which
  // refer to the rig and to this instrument.
  Measurement forecast(const capture::ShotSource& source, std::vector<ObservedShot>& opened);

 private:
  Measurement measure(const capture::ShotSource& source, Stopwatch& watch, bool without_noise,
                      std::vector<ObservedShot>& shots);

  const Rig& rig_;
  const ObjectScenes& objects_;
  MeasureOptions options_;
  Progress* progress_;
  std::optional<PoseResult> pose_;  // from the rig's points
  LitObjects lit_;
  std::optional<SharedView> view_;
  KeptLight kept_;
};

}  // namespace scattermeter::apps
