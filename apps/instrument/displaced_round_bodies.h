// Bodies without straight edges that stand elsewhere than stated, in shots with their own poses.
#pragma once

#include <vector>

#include "apps/instrument/finding.h"
#include "apps/rig/rig.h"
#include "capture/shots/shot_source.h"
#include "core/scene/object_scene.h"
#include "core/scene/observed_shot.h"

namespace scattermeter::apps {

// Those of the round objects (ObjectScene::is_round) whose shots are doubtful by `of_light` that
// are displaced: each of the object's doubtful shots shows light outside its outline, and a
// displacement explains the outline best. Displacements by less than the darkness of the limb hides
// are not told. frames: of the source of the shots.
std::vector<Finding> displaced_round_bodies(const Rig& rig, const ObjectScenes& objects,
                                            const std::vector<ObservedShot>& shots,
                                            const std::vector<Finding>& of_light,
                                            const capture::FrameSource& frames);

}  // namespace scattermeter::apps
