// What all channels together say about the quantities of the rig that they share.
#pragma once

#include <string>
#include <vector>

#include "core/estimation/channel_result.h"
#include "core/fit/prior_pulls.h"

namespace scattermeter {

// Whether a nuisance is one and the same for all channels: positions and directions of lights,
// camera and objects are; intensities, refractive index and levels may differ between them.
bool is_shared(const Nuisance& nuisance);
// Whether it has, besides those, one probable cause for all channels of a material: the scale, an
// LED's power, exposure times, eta, edges and the plane below. What the images of some channels
// contradict is then not to be trusted in the others, which may show nothing of it.
bool is_shared_by_material(const Nuisance& nuisance);

struct JointJudgement {
  // In the order of their first occurrence; image_relative is that of the channel in which it is
  // largest.
  std::vector<PriorPull> pulls;
  // Of all of them at once: if all statements hold, a chi-square with as many degrees of freedom as
  // there are combinations of which the images tell anything.
  double chi2 = 0;
  double dof = 0;
  double data_length = 0;  // of the whitened images of all channels
};

// The pulls of the nuisances for which `shared` is true, from the sum of the channels' evidence
// with the other nuisances of each eliminated.
JointJudgement joint_pulls(const std::vector<const RigEvidence*>& channels,
                           bool (*shared)(const Nuisance&) = is_shared);
// Of the results whose model explains their image.
JointJudgement joint_pulls_of(const std::vector<ChannelResult>& results);
// Of all results that converged where no model explains its image: what the rig most probably is
// like, and no judgement on it.
JointJudgement most_probable_pulls_of(const std::vector<ChannelResult>& results);
// Of those of one material, with what its channels probably share.
JointJudgement joint_pulls_of(const std::vector<ChannelResult>& results,
                              const std::string& material);

// If all channels together, or those of one material, contradict the rig, by one quantity
// (core/fit/prior_pulls.h) or by all of them at once, adds that as a reason to every result whose
// image the offset changes visibly. If
// one channel of a material does, and its model explains its image or a second channel does so as
// well, adds that to the other channels: the same rig made their images, even where it does not
// show. If the channels of a material together contradict the amount of unlisted light (even light,
// pedestals), adds that to those whose image it changes visibly. If two channels of a material are
// refused and their model misses their images, the others are refused as well.
void refuse_contradicted(std::vector<ChannelResult>& results);

}  // namespace scattermeter
