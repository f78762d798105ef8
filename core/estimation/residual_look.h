// What the residual of an image looks like.
#pragma once

#include <optional>
#include <vector>

#include "core/estimation/channel_result.h"
#include "core/estimation/material_channel.h"

namespace scattermeter {

// The pattern that explains most of the residual of the used rows: an equal amount of light
// everywhere (a pedestal), a gradient over the image, vignetting, a response that is not linear, a
// few spots, one shot, one face, or a band along outline and edges. Empty if none explains three
// tenths of what noise does not, or if the best one changes the image by less than a thousandth or
// might be noise (chi-square below 50 + parameters). rows: of the channel's shots, in their order,
// as predicted for the rig as it is stated: with nuisances at their stated values, since these
// imitate most of what is wrong.
std::optional<ResidualLook> residual_look(const std::vector<ShotRows>& rows,
                                          const MaterialChannel& channel);

}  // namespace scattermeter
