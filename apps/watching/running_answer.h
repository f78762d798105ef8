// What the shots so far say of a material, and what one more would add.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "apps/rig/rig.h"
#include "core/estimation/channel_result.h"
#include "core/scene/object_scene.h"

namespace scattermeter::apps {

struct RunningAnswer {
  std::vector<ChannelResult> channels;  // by the dipole
  std::string next;                     // the next shot of this material; "": none
  // With the next shot: relative standard deviations of sigma_s' and sigma_a, by channel as above;
  // empty where that cannot be forecast.
  std::vector<std::array<double, 2>> with_next;
};

// Those deviations for these shots of the rig, if the material is as measured: `rig` has the
// camera's place as its truth. Empty where a channel is refused or absorbs nothing.
std::vector<std::array<double, 2>> forecast(Rig rig, const ObjectScenes& objects,
                                            const std::string& material,
                                            const std::vector<ChannelResult>& channels,
                                            const std::vector<std::size_t>& shot_idxs);

}  // namespace scattermeter::apps
