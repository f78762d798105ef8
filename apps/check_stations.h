// What `check` looks at, one function each. All limits stand in CheckOptions.
#pragma once

#include <vector>

#include "apps/check_item.h"
#include "apps/checked_rig.h"

namespace scattermeter::apps {

// Apertures and ISO settings in use: one of each, as they change responsivity and noise.
std::vector<CheckItem> check_settings(const CheckedRig& checked);
// Residuals of the points or boards, their outliers, and how far the camera moved between shots.
std::vector<CheckItem> check_pose(const CheckedRig& checked);
// Clipped samples, dark shots.
std::vector<CheckItem> check_exposure(const CheckedRig& checked);
// Of shots of several files: each file's light against that of the others, by their times.
std::vector<CheckItem> check_bracket(const CheckedRig& checked);
// Scatter of the samples over the noise model.
std::vector<CheckItem> check_noise(const CheckedRig& checked);
// The darkest background against the file's black, and its change over the shots.
std::vector<CheckItem> check_black(const CheckedRig& checked);
// Which light and material each shot looks like.
std::vector<CheckItem> check_identity(const CheckedRig& checked);
// Each shot's light against the joint model: its power, its drift, even light from elsewhere.
std::vector<CheckItem> check_light(const CheckedRig& checked);
// Where the shots put the LEDs.
std::vector<CheckItem> check_led_places(const CheckedRig& checked);
// The objects' outline against pose, meshes and lens, and the camera's drift between shots.
std::vector<CheckItem> check_outline(const CheckedRig& checked);
// The shots of calibration.led that are in the folder against the rig's LEDs.
std::vector<CheckItem> check_led_shots(const CheckedRig& checked);
// Dark frames that are in the folder, and what the radiance calibration left.
std::vector<CheckItem> check_radiance(const CheckedRig& checked);

}  // namespace scattermeter::apps
