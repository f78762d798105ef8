// The rig's light probes, opened.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "apps/rig.h"
#include "core/entry_source.h"
#include "core/probe_tree.h"

namespace scattermeter::apps {

// Probes by the name of their light.
using RigProbes = std::map<std::string, ProbeTree>;

// Opens the probe of every environment that a shot is lit by. Throws InputError naming rig line,
// light, file and what is wrong.
RigProbes open_probes(const Rig& rig);

// Where paths of one of the rig's lights start on an object; `channel` 0 R, 1 G, 2 B. Scene, light
// and probes must outlive it.
std::unique_ptr<EntrySource> entry_of(const std::string& name, const RigLight& light,
                                      const RigProbes& probes, const RayScene& scene, int channel,
                                      double eta_int_over_ext);

}  // namespace scattermeter::apps
