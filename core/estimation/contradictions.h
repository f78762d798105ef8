// Answers that contradict the rig, alone or together.
#pragma once

#include <string>
#include <vector>

#include "core/agreement/joint_evidence.h"
#include "core/estimation/channel_result.h"

namespace scattermeter {

// What the channels say about the quantities of the rig that they share, from the results whose
// model explains their image.
JointJudgement joint_pulls_of(const std::vector<ChannelResult>& results);
// Of all results that converged where no model explains its image: what the rig most probably is
// like, and no judgement on it.
JointJudgement most_probable_pulls_of(const std::vector<ChannelResult>& results);
// Of those of one material, with what its channels probably share.
JointJudgement joint_pulls_of(const std::vector<ChannelResult>& results,
                              const std::string& material);

// If all channels together, or those of one material, contradict the rig, by one quantity
// (core/fit/prior_pulls.h) or by all of them at once, adds that as a reason to every result
// whose image the offset changes visibly. If one channel of a material does, and its model
// explains its image or a second channel does so as well, adds that to the other channels: the
// same rig made their images, even where it does not show. If the channels of a material
// together contradict the amount of unlisted light (even light, pedestals), adds that to those
// whose image it changes visibly. If two channels of a material are refused and their model
// misses their images, the others are refused as well. If a channel contradicts a quantity of
// its own (own_pulls_beside()), adds that to it.
void refuse_contradicted(std::vector<ChannelResult>& results);

}  // namespace scattermeter
