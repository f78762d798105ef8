#include "apps/instrument/open_shots.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include <oneapi/tbb/parallel_for.h>

#include "apps/instrument/focus.h"
#include "calib/pose/shot_pose.h"
#include "capture/shots/shot_cache.h"
#include "capture/shots/shot_key.h"
#include "capture/shots/shot_samples.h"
#include "core/base/progress.h"
#include "core/base/side_by_side.h"

namespace scattermeter::apps {
namespace {

// What the files' pedestals add to l (core/scene/observed_shot.h).
void subtract_pedestal(ObservedShot& shot) {
  for (std::size_t c = 0; c < kRgb; ++c) {
    ChannelObservation& o = shot.observation.channel[c];
    for (std::size_t k = 0; k < shot.exposures.size(); ++k) {
      const ShotExposure& e = shot.exposures[k];
      const double counts = e.pedestal_counts[c] * shot.exposure_s / e.true_s;
      if (counts == 0.0) continue;
      for (std::size_t j = 0; j < o.l.size(); ++j) {
        const double part = o.exposures.empty() ? 1.0 : o.exposures[k].of_row[j];
        o.l[j] -= counts * part * o.l_per_count[j];
      }
    }
  }
}

class ShotOpener {
 public:
  ShotOpener(const Rig& rig, const capture::ShotSource& source, const ObjectScenes& objects,
             const LitObjects& lit, const std::optional<SharedView>& shared,
             const std::map<std::string, OwnView>& own)
      : rig_(rig),
        source_(source),
        objects_(objects),
        lit_(lit),
        shared_(shared),
        own_(own),
        frames_(std::get_if<capture::FrameSource>(&source.open)),
        responsivity_(
            rig.scene.camera.responsivity.value_or(std::array<double, 3>{1.0, 1.0, 1.0})) {
    if (!shared && frames_ == nullptr) {
      throw std::invalid_argument("open_shots: samples without a pose from the rig's points");
    }
    if (!shared && !rig.pose.charuco) points_ = calib::pose_from_points(rig.scene, rig.pose);
  }

  ObservedShot open(std::size_t i) const {
    ObservedShot shot;
    shot.stated = &rig_.scene.shots.at(source_.shot_idxs[i]);
    if (shared_) {
      shot.pose = shared_->pose;
      shot.seen = shared_->objects.at(shot.stated->object);
    }
    const bool may_be_kept = source_.cache != nullptr && shared_ && frames_ != nullptr;
    std::string key;
    if (may_be_kept) {
      key =
          capture::shot_key(rig_.scene, rig_.decoding, shot, source_.names.at(i), *source_.digests);
      if (take_kept(key, shot)) return shot;
    }
    const CfaSamples samples = frames_ != nullptr ? decoded(i, shot) : given(i, shot);
    shot.exposure_s = samples.exposure_s;
    shot.observation = observe(samples, shot.seen->map, responsivity_);
    subtract_pedestal(shot);
    if (may_be_kept) source_.cache->keep(key, shot);
    return shot;
  }

 private:
  bool take_kept(const std::string& key, ObservedShot& shot) const {
    std::optional<DecodedShot> kept = source_.cache->find(key);
    if (!kept || kept->observation.channel[0].l.size() != shot.seen->map.patch_of_row.size() ||
        (is_judged_by_blur(shot) && !kept->edge_blur)) {
      return false;
    }
    static_cast<DecodedShot&>(shot) = std::move(*kept);
    return true;
  }

  // Of each material the first shot of each object, among those of the source.
  bool is_judged_by_blur(const ObservedShot& shot) const {
    const auto first =
        std::find_if(source_.shot_idxs.begin(), source_.shot_idxs.end(), [&](std::size_t idx) {
          const SceneShot& s = rig_.scene.shots.at(idx);
          return s.object == shot.stated->object && s.material == shot.stated->material;
        });
    return &rig_.scene.shots.at(*first) == shot.stated;
  }

  CfaSamples given(std::size_t i, ObservedShot& shot) const {
    shot.iso = rig_.scene.camera.iso;
    shot.f_number = rig_.scene.camera.f_number;
    return std::get<capture::SampleSource>(source_.open)(source_.shot_idxs[i], shot.seen->map);
  }

  CfaSamples decoded(std::size_t i, ObservedShot& shot) const {
    const std::vector<capture::RawFrame> exposures =
        capture::frames_of(*shot.stated, source_.shot_idxs[i], *frames_);
    const std::vector<std::string>& names = source_.names.at(i);
    shot.iso = exposures.front().iso;
    shot.f_number = exposures.front().f_number;
    if (!shared_) see_alone(i, exposures.front(), shot);
    const SampleMap& map = shot.seen->map;
    capture::ShotSamples out;
    // Neither needs the other.
    side_by_side(
        [&] {
          if (!is_judged_by_blur(shot)) return;
          shot.edge_blur = edge_blur(rig_, objects_, *shot.stated, exposures.front(), shot.pose);
        },
        [&] {
          out = capture::shot_samples(rig_.scene, rig_.decoding, *shot.stated, exposures, names,
                                      map.x0, map.y0, map.width, map.height);
        });
    for (const capture::RawFrame& f : exposures) {
      shot.samples_outside += f.samples.size() - static_cast<std::size_t>(map.width) *
                                                     static_cast<std::size_t>(map.height);
    }
    shot.exposures = std::move(out.exposures);
    shot.frame_mean_counts = out.frame_mean_counts;
    return std::move(out.samples);
  }

  // From points or a board, then, if the rig asks for it, from the silhouette.
  PoseResult own_pose(std::size_t i, const capture::RawFrame& frame) const {
    const std::string& name = source_.names.at(i).at(0);
    const PoseResult pose =
        points_ ? *points_ : calib::pose_from_board(rig_.scene, rig_.pose, frame, name);
    if (!rig_.pose.refine_by_silhouette) return pose;
    return calib::pose_from_silhouette(rig_.scene, rig_.pose, objects_, pose, source_.shot_idxs[i],
                                       frame, name);
  }

  void see_alone(std::size_t i, const capture::RawFrame& frame, ObservedShot& shot) const {
    const auto known = own_.find(shot.stated->file);
    const OwnView view = known != own_.end() ? known->second : OwnView{own_pose(i, frame)};
    shot.pose = view.pose;
    require_in_view(rig_.scene, objects_,
                    {rig_.scene.camera.intrinsics, shot.pose.camera_from_world},
                    shot.stated->object);
    shot.seen = see(rig_.scene, objects_, lit_, shot.stated->object, shot.pose, view.shift);
    shot.has_own_pose = true;
  }

  const Rig& rig_;
  const capture::ShotSource& source_;
  const ObjectScenes& objects_;
  const LitObjects& lit_;
  const std::optional<SharedView>& shared_;
  const std::map<std::string, OwnView>& own_;
  const capture::FrameSource* frames_;  // null: the source delivers samples
  // With a free scale, the unit of light is a count per second.
  std::array<double, 3> responsivity_;
  // From which each shot's own silhouette starts; absent with a board or a common pose.
  std::optional<PoseResult> points_;
};

}  // namespace

std::vector<ObservedShot> open_shots(const Rig& rig, const capture::ShotSource& source,
                                     const ObjectScenes& objects, const LitObjects& lit,
                                     const std::optional<SharedView>& shared, Progress* progress,
                                     const std::map<std::string, OwnView>& own) {
  const ShotOpener opener(rig, source, objects, lit, shared, own);
  std::vector<ObservedShot> shots(source.shot_idxs.size());
  ProgressStage stage(progress, "reading shots", shots.size());
  tbb::parallel_for(std::size_t{0}, shots.size(), [&](std::size_t i) {
    shots[i] = opener.open(i);
    stage.step();
  });
  // The camera's focus is that of the first shot.
  for (ObservedShot& shot : shots) {
    if (shot.edge_blur) continue;
    const auto first = std::find_if(shots.begin(), shots.end(), [&](const ObservedShot& s) {
      return s.edge_blur && s.stated->object == shot.stated->object &&
             s.stated->material == shot.stated->material;
    });
    if (first != shots.end()) shot.edge_blur = first->edge_blur;
  }
  return shots;
}

}  // namespace scattermeter::apps
