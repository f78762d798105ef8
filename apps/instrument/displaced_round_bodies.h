// Round bodies that stand elsewhere than stated, in shots with their own poses.
#pragma once

#include <vector>

#include "apps/instrument/finding.h"
#include "apps/instrument/outline_watch.h"
#include "apps/rig/rig.h"
#include "capture/shots/shot_source.h"
#include "core/scene/object_scene.h"
#include "core/scene/observed_shot.h"

namespace scattermeter::apps {

// Appends to the findings those of the unjudged objects (whose outlines have too few straight edges
// for find_piece()) that are displaced: each of the object's shots that are doubtful by `of_light`
// shows light outside its outline, and a displacement explains the outline best. Displacements by
// less than the darkness of the limb hides are not told. frames: of the source of the shots.
void find_displaced_round_bodies(const Rig& rig, const ObjectScenes& objects,
                                 const std::vector<ObservedShot>& shots,
                                 const std::vector<Finding>& of_light,
                                 const capture::FrameSource& frames, OutlineFindings& outlines);

}  // namespace scattermeter::apps
