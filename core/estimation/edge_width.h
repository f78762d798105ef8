// How far the edges of each piece are cut back, as its image shows.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/estimation/channel_result.h"
#include "core/scene/scene.h"

namespace scattermeter {

// mm, by material and object; pieces that are not listed: chamfer_width_mm().
using EdgeWidths = std::map<std::pair<std::string, std::string>, double>;

// The light lost at edges is not quite proportional to the width of their chamfers, so its
// derivative is taken at the width found. Takes the widths that the channels of each material find,
// in their median, where that changes the light visibly; returns for which of the converged results
// the width is another one now.
std::vector<bool> take_edge_widths(const Scene& scene, const std::vector<ChannelResult>& results,
                                   EdgeWidths& widths_mm);

}  // namespace scattermeter
