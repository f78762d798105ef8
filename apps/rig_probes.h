// The rig's light probes, opened.
#pragma once

#include <map>
#include <string>

#include "apps/rig.h"
#include "core/probe_tree.h"

namespace scattermeter::apps {

// Probes by the name of their light.
using RigProbes = std::map<std::string, ProbeTree>;

// Opens the probe of every environment that a shot is lit by. Throws InputError naming rig line,
// light, file and what is wrong.
RigProbes open_probes(const Rig& rig);

}  // namespace scattermeter::apps
