// The shots of a measurement, opened from one view after another.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/instrument/open_shots.h"
#include "apps/rig/rig.h"
#include "capture/shots/shot_source.h"
#include "core/base/progress.h"
#include "core/camera/pose_shift.h"
#include "core/estimation/estimation.h"
#include "core/scene/lit_objects.h"
#include "core/scene/object_scene.h"
#include "core/scene/observed_shot.h"
#include "core/scene/seen_object.h"

namespace scattermeter::apps {

// Patches in the shots.
std::size_t rows_of(const std::vector<ObservedShot>& shots);

class SeenShots {
 public:
  // view: common to all shots; absent: each has its own. on_smooth_knots: W on them is computed
  // while the shots are read. levels: of the choice of rows (core/view/chosen_rows.h), where that
  // leaves at most half of them; absent: all rows. kept: the light of that view. All references
  // must outlive it.
  SeenShots(const Rig& rig, const ObjectScenes& objects, LitObjects& lit,
            const capture::ShotSource& source, std::optional<SharedView> view, bool on_smooth_knots,
            std::optional<int> levels, KeptLight& kept, Progress* progress);
  SeenShots(const SeenShots&) = delete;
  SeenShots& operator=(const SeenShots&) = delete;

  // With the chosen rows.
  const std::vector<ObservedShot>& shots() const { return levels_ ? chosen_ : shots_; }
  // Common to all shots, as it is now; absent: each has its own.
  const std::optional<SharedView>& view() const { return view_; }
  // With all rows.
  const std::vector<ObservedShot>& whole() const { return shots_; }
  std::optional<int> levels() const { return levels_; }
  // All rows over the chosen ones.
  double all_rows() const;
  // Chooses other rows of the open shots.
  void choose(std::optional<int> levels);
  // The light of the view that is open.
  KeptLight& kept() const { return *kept_; }

  // Throws InputError and Cancelled as open_shots() does.
  void open() { open(source_); }
  // From another source of the same shots.
  void open(const capture::ShotSource& from);
  // Again, from views that are shifted: by ObservedShot::view_name(). Precondition: they are open.
  void open_from(const std::map<std::string, PoseShift>& shifts);
  // Of the objects of all shots, open now and later: ObservedShot::size_open_relative.
  void leave_sizes_open(std::map<std::string, double> of_objects);
  // Takes these shots out of the cache, and keeps none from now on.
  void forget();

 private:
  std::vector<ObservedShot> open_and_light(const capture::ShotSource& from);
  // Whether the levels leave at most half of the rows of these whole views.
  bool is_worth_choosing(const std::vector<ObservedShot>& shots) const;
  // The chosen rows of a whole view. Precondition: there are levels.
  const ThinnedView& thinned(const SeenObject& whole) const;

  const Rig& rig_;
  const ObjectScenes& objects_;
  LitObjects& lit_;
  capture::ShotSource source_;
  std::optional<SharedView> view_;
  std::map<std::string, OwnView> own_;  // without a common view
  std::map<std::string, double> sizes_open_;
  bool on_smooth_knots_;
  std::optional<int> levels_;
  KeptLight shifted_;
  KeptLight* kept_;
  Progress* progress_;
  std::vector<ObservedShot> shots_;   // with all rows
  std::vector<ObservedShot> chosen_;  // empty without levels
};

}  // namespace scattermeter::apps
