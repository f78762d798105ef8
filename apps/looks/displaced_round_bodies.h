// Round bodies that stand elsewhere than stated.
#pragma once

#include <cstddef>
#include <set>
#include <vector>

#include "apps/looks/finding.h"
#include "apps/looks/outline_watch.h"
#include "apps/rig/rig.h"
#include "capture/shots/shot_source.h"
#include "core/estimation/channel_result.h"
#include "core/scene/object_scene.h"
#include "core/scene/observed_shot.h"

namespace scattermeter::apps {

// Appends to the findings those of the unjudged objects (whose outlines have too few straight
// edges) that are displaced: each of the object's doubtful shots (indices in the scene) shows light
// outside its outline, and a displacement explains the outline best. Displacements by less than the
// darkness of the limb hides are not told. frames: of the source of the shots.
void find_displaced_round_bodies(const Rig& rig, const ObjectScenes& objects,
                                 const std::vector<ObservedShot>& shots,
                                 const std::set<std::size_t>& doubtful,
                                 const capture::FrameSource& frames, OutlineFindings& outlines);

// The same for the shots of the results that a fit has refused: what is found becomes the first
// reason of those results.
void tell_of_displaced_round_bodies(const Rig& rig, const ObjectScenes& objects,
                                    const std::vector<ObservedShot>& shots,
                                    const capture::FrameSource& frames,
                                    std::vector<ChannelResult>& results);

}  // namespace scattermeter::apps
