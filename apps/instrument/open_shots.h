// Shots of a rig, from frames to one l per visible patch and channel.
#pragma once

#include <optional>
#include <vector>

#include "apps/rig/rig.h"
#include "capture/shots/shot_source.h"
#include "core/base/progress.h"
#include "core/scene/lit_objects.h"
#include "core/scene/observed_shot.h"
#include "core/scene/seen_object.h"

namespace scattermeter::apps {

// Gets every shot of the source and reduces it to one l per visible patch and channel. With the
// pose of all shots (`shared`), shots of one object share their map; without, each has a pose of
// its own, from a board or its silhouette (a FrameSource, then: std::invalid_argument otherwise).
// With the pose of all shots, too, those that the source's cache holds are not decoded.
std::vector<ObservedShot> open_shots(const Rig& rig, const capture::ShotSource& source,
                                     const ObjectScenes& objects, const LitObjects& lit,
                                     const std::optional<SharedView>& shared, Progress* progress);

}  // namespace scattermeter::apps
