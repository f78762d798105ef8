#include "apps/instrument/seen_shots.h"

#include <algorithm>
#include <exception>
#include <utility>

#include <oneapi/tbb/parallel_invoke.h>

#include "capture/shots/shot_cache.h"
#include "core/estimation/channel_weights.h"

namespace scattermeter::apps {

std::size_t rows_of(const std::vector<ObservedShot>& shots) {
  std::size_t rows = 0;
  for (const ObservedShot& shot : shots) rows += shot.seen->sites.size();
  return rows;
}

namespace {

// What blur does is told from adjacent rows (core/view/row_blur.h). Less than a twentieth of a
// patch changes no light by more than a thousandth.
bool is_blurred(const ObservedShot& shot) {
  constexpr double kVisible = 0.05;
  return shot.edge_blur &&
         shot.edge_blur->largest_std_mm() > kVisible * shot.seen->patches->patch_size_mm();
}

}  // namespace

SeenShots::SeenShots(const Rig& rig, const ObjectScenes& objects, LitObjects& lit,
                     const capture::ShotSource& source, std::optional<SharedView> view,
                     bool on_smooth_knots, std::optional<int> levels, KeptLight& kept,
                     Progress* progress)
    : rig_(rig),
      objects_(objects),
      lit_(lit),
      source_(source),
      view_(std::move(view)),
      on_smooth_knots_(on_smooth_knots),
      levels_(levels),
      kept_(&kept),
      progress_(progress) {}

void SeenShots::open(const capture::ShotSource& from) {
  shots_ = view_ && on_smooth_knots_
               ? open_and_light(from)
               : open_shots(rig_, from, objects_, lit_, view_, progress_, own_);
  if (!is_worth_choosing(shots_) || std::any_of(shots_.begin(), shots_.end(), is_blurred)) {
    levels_ = std::nullopt;
  }
  leave_sizes_open(sizes_open_);
}

void SeenShots::leave_sizes_open(std::map<std::string, double> of_objects) {
  sizes_open_ = std::move(of_objects);
  for (ObservedShot& shot : shots_) {
    const auto open = sizes_open_.find(shot.stated->object);
    shot.size_open_relative = open == sizes_open_.end() ? 0.0 : open->second;
  }
  choose(levels_);
}

const ThinnedView& SeenShots::thinned(const SeenObject& whole) const {
  const auto [it, is_new] = kept_->thinned.try_emplace({&whole, *levels_});
  ThinnedView& view = it->second;
  if (is_new) {
    std::vector<Eigen::Vector3d> centers_mm;
    for (const ExitSite& site : whole.sites) centers_mm.push_back(site.center_mm);
    view.choice = spread_rows(centers_mm, *levels_);
    view.seen = with_rows(whole, view.choice);
  }
  return view;
}

bool SeenShots::is_worth_choosing(const std::vector<ObservedShot>& shots) const {
  if (!levels_) return false;
  std::size_t some = 0;
  for (const ObservedShot& shot : shots) {
    some += std::min(shot.seen->sites.size(), std::size_t{1} << *levels_);
  }
  return rows_of(shots) >= 2 * some;
}

double SeenShots::all_rows() const {
  return static_cast<double>(rows_of(whole())) / static_cast<double>(rows_of(shots()));
}

void SeenShots::choose(std::optional<int> levels) {
  levels_ = levels;
  chosen_.clear();
  if (!levels_) return;
  for (const ObservedShot& shot : shots_) {
    const ThinnedView& view = thinned(*shot.seen);
    ObservedShot& out = chosen_.emplace_back(shot);
    out.seen = view.seen;
    out.observation = with_rows(shot.observation, view.choice);
  }
}

void SeenShots::open_from(const std::map<std::string, PoseShift>& shifts) {
  shifted_ = {{}, {}, kept_->atlas};
  kept_ = &shifted_;
  if (view_) {
    view_ = see_all(rig_.scene, objects_, lit_, view_->pose, shifts, rig_.scene.objects_in_shots());
  } else {
    for (const ObservedShot& shot : shots_) {
      OwnView& own = own_[shot.stated->file] = {shot.pose};
      if (const auto by = shifts.find(shot.view_name()); by != shifts.end()) own.shift = by->second;
    }
  }
  open();
}

void SeenShots::forget() {
  if (source_.cache != nullptr) source_.cache->forget();
  source_.cache = nullptr;
}

// Reads the shots and, at the same time, computes W for their views and lights, as neither depends
// on the other.
std::vector<ObservedShot> SeenShots::open_and_light(const capture::ShotSource& from) {
  std::vector<ObservedShot> unread(from.shot_idxs.size());
  for (std::size_t i = 0; i < unread.size(); ++i) {
    unread[i].stated = &rig_.scene.shots.at(from.shot_idxs[i]);
    unread[i].seen = view_->objects.at(unread[i].stated->object);
  }
  if (!is_worth_choosing(unread)) levels_ = std::nullopt;
  if (levels_) {
    for (ObservedShot& shot : unread) shot.seen = thinned(*shot.seen).seen;
  }
  std::vector<ObservedShot> shots;
  // Both ends are awaited: an exception would cancel the loops of the other, and half of W would be
  // kept as if it were whole.
  std::exception_ptr of_shots, of_light;
  const auto guarded = [](std::exception_ptr& error, const auto& work) {
    try {
      work();
    } catch (...) {
      error = std::current_exception();
    }
  };
  tbb::parallel_invoke(
      [&] {
        guarded(of_shots,
                [&] { shots = open_shots(rig_, from, objects_, lit_, view_, progress_); });
      },
      [&] {
        guarded(of_light, [&] {
          add_smooth_weights(rig_.scene, unread, lit_, nullptr, kept_->weights, kept_->store.get());
        });
      });
  for (const std::exception_ptr& error : {of_shots, of_light}) {
    if (error) std::rethrow_exception(error);
  }
  return shots;
}

}  // namespace scattermeter::apps
