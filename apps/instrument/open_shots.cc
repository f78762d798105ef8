#include "apps/instrument/open_shots.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include <oneapi/tbb/parallel_for.h>

#include "calib/pose/shot_pose.h"
#include "capture/shots/shot_cache.h"
#include "capture/shots/shot_key.h"
#include "capture/shots/shot_samples.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

std::vector<ObservedShot> open_shots(const Rig& rig, const capture::ShotSource& source,
                                     const ObjectScenes& objects, const LitObjects& lit,
                                     const std::optional<SharedView>& shared, Progress* progress) {
  const capture::FrameSource* frames = std::get_if<capture::FrameSource>(&source.open);
  if (!shared && frames == nullptr) {
    throw std::invalid_argument("open_shots: samples without a pose from the rig's points");
  }
  // With a free scale, the unit of light is a count per second.
  const std::array<double, 3> responsivity =
      rig.scene.camera.responsivity.value_or(std::array<double, 3>{1.0, 1.0, 1.0});
  // The pose from which each shot's own silhouette starts if there is no board.
  std::optional<PoseResult> points;
  if (!shared && !rig.pose.charuco) points = calib::pose_from_points(rig.scene, rig.pose);
  std::vector<ObservedShot> shots(source.shot_idxs.size());
  ProgressStage stage(progress, "reading shots", shots.size());
  tbb::parallel_for(std::size_t{0}, shots.size(), [&](std::size_t i) {
    ObservedShot& shot = shots[i];
    const std::size_t idx = source.shot_idxs[i];
    shot.stated = &rig.scene.shots.at(idx);
    if (shared) {
      shot.pose = shared->pose;
      shot.seen = shared->objects.at(shot.stated->object);
    }
    const bool may_be_kept = source.cache != nullptr && shared && frames != nullptr;
    std::string key;
    if (may_be_kept) {
      key = capture::shot_key(rig.scene, rig.decoding, shot, source.names.at(i), *source.digests);
      if (std::optional<DecodedShot> kept = source.cache->find(key);
          kept && kept->observation.channel[0].l.size() == shot.seen->map.patch_of_row.size()) {
        static_cast<DecodedShot&>(shot) = std::move(*kept);
        stage.step();
        return;
      }
    }
    CfaSamples samples;
    if (frames != nullptr) {
      const std::vector<capture::RawFrame> exposures =
          capture::frames_of(*shot.stated, idx, *frames);
      const capture::RawFrame& frame = exposures.front();
      const std::vector<std::string>& names = source.names.at(i);
      shot.iso = frame.iso;
      shot.f_number = frame.f_number;
      if (!shared) {
        shot.pose =
            points ? *points : calib::pose_from_board(rig.scene, rig.pose, frame, names.at(0));
        if (rig.pose.refine_by_silhouette) {
          shot.pose = calib::pose_from_silhouette(rig.scene, rig.pose, objects, shot.pose, idx,
                                                  frame, names.at(0));
        }
        require_in_view(rig.scene, objects,
                        {rig.scene.camera.intrinsics, shot.pose.camera_from_world},
                        shot.stated->object);
        shot.seen = see(rig.scene, objects, lit, shot.stated->object, shot.pose);
        shot.has_own_pose = true;
      }
      const SampleMap& map = shot.seen->map;
      capture::ShotSamples of_shot =
          capture::shot_samples(rig.scene, rig.decoding, *shot.stated, exposures, names, map.x0,
                                map.y0, map.width, map.height);
      for (const capture::RawFrame& f : exposures) {
        shot.samples_outside += f.samples.size() - static_cast<std::size_t>(map.width) *
                                                       static_cast<std::size_t>(map.height);
      }
      shot.exposures = std::move(of_shot.exposures);
      shot.frame_mean_counts = of_shot.frame_mean_counts;
      samples = std::move(of_shot.samples);
    } else {
      shot.iso = rig.scene.camera.iso;
      shot.f_number = rig.scene.camera.f_number;
      samples = std::get<capture::SampleSource>(source.open)(idx, shot.seen->map);
    }
    shot.exposure_s = samples.exposure_s;
    shot.observation = observe(samples, shot.seen->map, responsivity);
    if (may_be_kept) source.cache->keep(key, shot);
    stage.step();
  });
  return shots;
}

}  // namespace scattermeter::apps
