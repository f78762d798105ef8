// What all channels together say about the quantities of the rig that they share.
#pragma once

#include <vector>

#include "core/fit/linear_shot.h"
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
// The pulls of the nuisances of `one` that are not shared (is_shared), with what the others say
// about those that are: a channel that alone can explain its image by other positions than the
// others see contradicts its scale. `others` may contain `one`, which does not count twice.
std::vector<PriorPull> own_pulls_beside(const RigEvidence& one,
                                        const std::vector<const RigEvidence*>& others);

}  // namespace scattermeter
