// Consistency check of a rig: the residual of every calibration compared with its limit.
#pragma once

#include <string>
#include <vector>

#include "apps/checking/check_item.h"
#include "apps/checking/checked_rig.h"
#include "apps/rig/rig.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

struct CheckReport {
  std::vector<CheckItem> items;  // failures first
  // The one cause that explains most of the failures, as a sentence with advice; "" if none failed
  // or none explains them. The failures are then its consequences.
  std::string cause;
  std::vector<std::string> notes;
  bool passed() const;
};

// One check of the rig, which reads no file. All limits are in CheckOptions.
using Check = std::vector<CheckItem> (*)(const CheckedRig&);

// What `measure` sees before any fit and refuses: outlines, exchanged lights and files, covered
// objects, units.
std::vector<CheckItem> check_first_look(const CheckedRig& checked);
// Apertures and ISO settings in use: a rig has one of each, as they change responsivity and noise.
std::vector<CheckItem> check_settings(const CheckedRig& checked);
// Residuals of the points or boards, their outliers, and the camera's motion between shots.
std::vector<CheckItem> check_pose(const CheckedRig& checked);
// Clipped samples and dark shots.
std::vector<CheckItem> check_exposure(const CheckedRig& checked);
// For shots of several files: the light in each file against that in the others, scaled by time.
std::vector<CheckItem> check_bracket(const CheckedRig& checked);
// Scatter of the samples relative to the noise model.
std::vector<CheckItem> check_noise(const CheckedRig& checked);
// Of samples that scatter far less than the noise model says, which fails no check but widens the
// results; "": there are none.
std::string quiet_note(const CheckedRig& checked);
// The darkest background against the black level of the file, and its drift over the shots.
std::vector<CheckItem> check_black(const CheckedRig& checked);
// The light and the material that each shot looks like.
std::vector<CheckItem> check_identity(const CheckedRig& checked);
// The light of each shot against the joint model: power, drift, uniform light from elsewhere.
std::vector<CheckItem> check_light(const CheckedRig& checked);
// LED positions as estimated from the shots.
std::vector<CheckItem> check_led_places(const CheckedRig& checked);
// The outlines of the objects against pose, meshes and lens, and the camera's drift between shots.
std::vector<CheckItem> check_outline(const CheckedRig& checked);
// The shots of calibration.led that are in the folder against the LEDs of the rig.
std::vector<CheckItem> check_led_shots(const CheckedRig& checked);
// Dark frames in the folder, and the residuals of the radiance calibration.
std::vector<CheckItem> check_radiance(const CheckedRig& checked);

// All of them in the order of the report. A new check is declared above and added to this table.
const std::vector<Check>& checks();

// The cause of the failures: the first finding of the looks before any fit; otherwise the single
// change of the rig that explains at least half of what the joint model leaves of the images
// (apps/checking/image_causes.h), if their check failed. "" if there is none.
std::string probable_cause(const CheckedRig& checked, const std::vector<CheckItem>& items);

// Runs every check on the shots of the rig.
CheckReport check_report(const CheckedRig& checked);

// Opens the shots, runs every check and reports. Throws InputError for anything that measure()
// would refuse to read, and Cancelled if `progress` does.
CheckReport check(const Rig& rig, const std::string& shots_folder, const CheckOptions& options = {},
                  Progress* progress = nullptr);

}  // namespace scattermeter::apps
