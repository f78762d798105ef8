// A rig made ready to measure: geometry, light and weights are computed once and serve many sets of
// shots.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/instrument/atlas_folder.h"
#include "apps/instrument/led_watch.h"
#include "apps/instrument/measure.h"
#include "apps/instrument/sample_map_folder.h"
#include "apps/instrument/weight_folder.h"
#include "apps/looks/first_look.h"
#include "apps/looks/outline_watch.h"
#include "apps/rig/rig.h"
#include "capture/shots/shot_source.h"
#include "core/base/progress.h"
#include "core/base/stopwatch.h"
#include "core/estimation/estimation.h"
#include "core/scene/lit_objects.h"
#include "core/scene/observed_shot.h"
#include "core/scene/seen_object.h"

namespace scattermeter::apps {

class SeenShots;

class Instrument {
 public:
  // Rig and objects must outlive it; the objects may have been opened for another rig with the same
  // objects. Throws InputError if the rig's points do not determine the pose, an object is out of
  // view or patches are too small.
  Instrument(const Rig& rig, const ObjectScenes& objects, const MeasureOptions& options,
             Progress* progress = nullptr);
  Instrument(const Instrument&) = delete;
  Instrument& operator=(const Instrument&) = delete;

  // Measures the materials in these shots, jointly over the shots of each. The weights W of each
  // view and light are computed when first needed; they are kept if the pose comes from the rig's
  // points alone, but not with a board or silhouettes. The digits are the same either way. Before
  // any fit, outlines and light of the shots are looked at (outline_watch.h, light_look.h):
  // channels whose shots contradict the rig are refused at once. Where outlines show that pieces
  // stand elsewhere within the rig's uncertainty, they are measured there (piece_look.h); of what
  // has no edges the fit of all channels tells, and the shots are opened again and fitted from
  // there (core/nuisances/view_shift.h). Fills in results, patch sizes, timing and the notes of
  // these looks; inputs are left to the caller. Throws InputError as measure() does. Must not be
  // called from several threads at once (it uses all of them).
  Measurement measure(const capture::ShotSource& source);
  Measurement measure(const capture::ShotSource& source,
                      Stopwatch& watch);  // records the timing there only
  // Measures by the dipole shots that are free of noise but have its variances: the stated values
  // are those to expect of shots with noise. opened: receives these shots, which refer to the rig
  // and to this instrument.
  Measurement forecast(const capture::ShotSource& source, std::vector<ObservedShot>& opened);

  // Opens these shots and looks at outlines and light as measure() does before any fit.
  FirstLook look(const capture::ShotSource& source);

  // From the rig's points; empty if it has none.
  const std::optional<PoseResult>& pose_of_points() const { return pose_; }

 private:
  // The view that these shots share, if they do.
  std::optional<SharedView> view_of(const capture::ShotSource& source);
  OutlineFindings open_and_look(const capture::ShotSource& source, SeenShots& seen);
  FirstLook look_first(const capture::ShotSource& source, bool smooth, OutlineFindings outlines,
                       SeenShots& seen, Stopwatch& watch);
  Measurement measure(const capture::ShotSource& source, Stopwatch& watch, bool without_noise,
                      std::vector<ObservedShot>& opened);
  // By a rig whose pieces or LEDs are where the shots showed them.
  Measurement measure_there(const Rig& rig, const ObjectScenes& objects, bool is_moved,
                            int led_moves, const capture::ShotSource& source,
                            Stopwatch& watch) const;
  Measurement measure_moved(const capture::ShotSource& source, Stopwatch& watch,
                            const MovedPieces& pieces) const;
  Measurement measure_relit(const capture::ShotSource& source, Stopwatch& watch,
                            const LedDisplacements& leds) const;

  void tell_of_shots(const capture::ShotSource& source, const SeenShots& seen,
                     std::vector<ChannelResult>& results) const;
  void tell_unkept(Measurement& out);

  const Rig& rig_;
  const ObjectScenes& objects_;
  MeasureOptions options_;
  Progress* progress_;
  std::optional<PoseResult> pose_;  // from the rig's points
  LitObjects lit_;
  std::optional<SharedView> view_;
  std::shared_ptr<AtlasFolder> atlas_;     // null: in memory only
  std::shared_ptr<WeightFolder> weights_;  // null: not kept
  std::optional<SampleMapFolder> maps_;    // absent: not kept
  KeptLight kept_;
  bool is_moved_ = false;  // the rig's pieces stand where their outlines showed them
  int led_moves_ = 0;      // how often its LEDs were put where the shots showed them
};

}  // namespace scattermeter::apps
