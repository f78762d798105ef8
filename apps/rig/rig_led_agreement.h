// Whether the LEDs of a rig agree with each other and with its camera.
#pragma once

#include "apps/rig/rig.h"
#include "apps/rig/yaml_field.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

// All throw InputError with file, line and field. lights: the rig's map of that name, for messages.

// The intensities of calibrated LEDs are valid for the responsivity in their files. A rig without a
// responsivity takes it, and its scale is then as uncertain as the intensities; a rig with another
// one is refused.
void take_responsivity_of_leds(const YamlField& lights, Rig& rig);

// Refuses a lamp that was copied from another one in the file, and then not edited.
void require_different_leds(const YamlField& lights, const Scene& scene);

// Before objects are measured or checked: their shots must be read as those were from which the
// LEDs' intensities are known, corrected by a calibration of radiance (camera.radiance) or not.
void require_radiance_of_leds(const Rig& rig);

}  // namespace scattermeter::apps
