// What the shots of a rig's calibration.led show of one light.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "apps/rig.h"
#include "calib/led_scene.h"
#include "capture/raw_frame.h"

namespace scattermeter::apps {

// A shot of calibration.led, by its place in the list.
using LedFrames = std::function<capture::RawFrame(std::size_t shot)>;

// The shots as files in a folder. Throws InputError when a file is missing or no shot of the rig's
// camera.
LedFrames led_frames_in(const Rig& rig, const std::string& shots_folder);

// Responsivity that stands in where the rig has none, in all channels: intensities then count for
// it, and only their product matters.
inline constexpr double kNominalResponsivity = 1e10;  // counts mm^2 sr / (W s)

// One shot of a plane, as a grid of cells.
struct LedPlaneGrid {
  std::string file;
  std::size_t shot = 0;  // calib::ShadedCell::shot
  int columns = 0, rows = 0;
};

struct LedShots {
  calib::LedScene scene;
  std::vector<std::string> files;            // of the scene's views, for messages
  std::vector<std::string> highlight_names;  // one per highlight: "spheres_led1.dng sphere 2"
  std::vector<LedPlaneGrid> grids;
  std::array<double, 3> responsivity{};  // the rig's or the nominal one
  std::vector<std::string> notes;        // spheres without a highlight and why; clipped planes
};

// Poses, highlights and cells of all shots of a light; a plane's ambient shot is subtracted from
// its cells. Throws InputError for a light that the rig does not have or that is no LED, a light
// without shots, a plane that no shot shows, a pose that cannot be had.
LedShots read_led_shots(const Rig& rig, const std::string& light, const LedFrames& frames);

}  // namespace scattermeter::apps
