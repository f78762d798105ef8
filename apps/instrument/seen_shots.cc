#include "apps/instrument/seen_shots.h"

#include <exception>
#include <utility>

#include <oneapi/tbb/parallel_invoke.h>

#include "apps/instrument/open_shots.h"
#include "capture/shots/shot_cache.h"
#include "core/estimation/channel_weights.h"

namespace scattermeter::apps {

SeenShots::SeenShots(const Rig& rig, const ObjectScenes& objects, LitObjects& lit,
                     const capture::ShotSource& source, std::optional<SharedView> view,
                     bool on_smooth_knots, KeptLight& kept, Progress* progress)
    : rig_(rig),
      objects_(objects),
      lit_(lit),
      source_(source),
      view_(std::move(view)),
      on_smooth_knots_(on_smooth_knots),
      kept_(&kept),
      progress_(progress) {}

void SeenShots::open(const capture::ShotSource& from) {
  shots_ = view_ && on_smooth_knots_ ? open_and_light(from)
                                     : open_shots(rig_, from, objects_, lit_, view_, progress_);
}

void SeenShots::open_from(const std::map<std::string, PoseShift>& shifts) {
  if (!view_) return;
  shifted_ = {{}, {}, kept_->atlas};
  kept_ = &shifted_;
  view_ = see_all(rig_.scene, objects_, lit_, view_->pose, shifts, rig_.scene.objects_in_shots());
  open();
}

void SeenShots::forget() {
  if (source_.cache != nullptr) source_.cache->forget();
  source_.cache = nullptr;
}

// Reads the shots and, at the same time, computes W for their views and lights, as neither depends
// on the other.
std::vector<ObservedShot> SeenShots::open_and_light(const capture::ShotSource& from) const {
  std::vector<ObservedShot> unread(from.shot_idxs.size());
  for (std::size_t i = 0; i < unread.size(); ++i) {
    unread[i].stated = &rig_.scene.shots.at(from.shot_idxs[i]);
    unread[i].seen = view_->objects.at(unread[i].stated->object);
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
