// Evaluation of the calibration shots of one LED.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "calib/led/led_calibration_input.h"
#include "calib/led/led_scene.h"
#include "capture/raw/raw_frame.h"

namespace scattermeter::calib {

// Opens the shot with an index into LedCalibrationShots::shots.
using LedFrames = std::function<capture::RawFrame(std::size_t shot)>;

// Responsivity of each channel if none is given: only its product with the intensities then has a
// meaning.
inline constexpr double kNominalResponsivity = 1e10;  // counts mm^2 sr / (W s)

// One shot of a plane, as a grid of cells.
struct LedPlaneGrid {
  std::string file;
  std::size_t shot = 0;  // ShadedCell::shot
  int columns = 0, rows = 0;
};

struct LedShots {
  LedScene scene;
  std::vector<std::string> files;            // one per view of the scene, for messages
  std::vector<std::string> highlight_names;  // one per highlight: "spheres_led1.dng sphere 2"
  std::vector<LedPlaneGrid> grids;
  std::array<double, 3> responsivity{};  // the rig's or the nominal one
  std::vector<std::string> notes;        // spheres without a highlight and why; clipped planes
};

// Poses, highlights and cells of all shots of an LED; the ambient shot of a plane is subtracted
// from its cells. Throws InputError for a light that is not in the input or has no shots, for a
// plane that is out of view, and if a pose cannot be determined or a frame cannot be opened.
LedShots read_led_shots(const LedCalibrationInput& input, const std::string& light,
                        const LedFrames& frames);

}  // namespace scattermeter::calib
