// Opening of a rig's shots: from frames to one l per visible patch and channel.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/rig/rig.h"
#include "capture/shots/shot_source.h"
#include "core/base/progress.h"
#include "core/scene/lit_objects.h"
#include "core/scene/observed_shot.h"
#include "core/scene/seen_object.h"

namespace scattermeter::apps {

// A shot with a pose of its own: that pose, and the shift from it to the view that is looked from.
struct OwnView {
  PoseResult pose;
  PoseShift shift = PoseShift::Zero();
};

// Opens every shot of the source and reduces it to one l per visible patch and channel. With a
// common pose of all shots (`shared`), the shots of one object share their map, and shots in the
// source's cache are not decoded. Without, each shot has its own pose, from a board or its
// silhouette; the source must then be a FrameSource (std::invalid_argument otherwise). own: by
// file, of such shots whose poses are known from an earlier look.
std::vector<ObservedShot> open_shots(const Rig& rig, const capture::ShotSource& source,
                                     const ObjectScenes& objects, const LitObjects& lit,
                                     const std::optional<SharedView>& shared, Progress* progress,
                                     const std::map<std::string, OwnView>& own = {});

}  // namespace scattermeter::apps
