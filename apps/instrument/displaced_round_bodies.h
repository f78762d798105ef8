// Round bodies that stand elsewhere than stated, in shots with their own poses.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "apps/instrument/finding.h"
#include "apps/rig/rig.h"
#include "capture/shots/shot_source.h"
#include "core/scene/object_scene.h"
#include "core/scene/observed_shot.h"

namespace scattermeter::apps {

// Those of the objects `names`, whose outlines have too few straight edges for find_piece(), that
// are displaced: each of the object's shots that are doubtful by `of_light` shows light outside its
// outline, and a displacement explains the outline best. Displacements by less than the darkness of
// the limb hides are not told. frames: of the source of the shots.
std::vector<Finding> displaced_round_bodies(const Rig& rig, const ObjectScenes& objects,
                                            const std::vector<ObservedShot>& shots,
                                            const std::set<std::string>& names,
                                            const std::vector<Finding>& of_light,
                                            const capture::FrameSource& frames);

}  // namespace scattermeter::apps
