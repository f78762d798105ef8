// Simulation of the shots of a rig's calibration.camera.
#pragma once

#include <string>
#include <vector>

#include "apps/rig/rig.h"
#include "apps/simulation/simulate.h"
#include "core/base/progress.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {

// Expected counts above black of a board in the world's plane z = 0 with its origin in the world's,
// seen by `view`; white and errors are as for board_shot_counts(). where, file: for messages.
std::vector<float> board_counts(const Rig& rig, const CameraView& view,
                                const calib::CalibrationBoard& board, const std::string& where,
                                const std::string& file);

// Expected counts above black of one board shot, each pixel in the channel of its filter. White in
// full light (apps/simulation/board_signal.h) reaches 0.7 of the range in the most sensitive
// channel, and less in the others in proportion to the responsivity. Throws InputError if the board
// is behind the camera or out of the frame.
std::vector<float> board_shot_counts(const Rig& rig, const calib::BoardShot& shot);

// Writes the shots into `out_folder`, which must exist, and returns the paths of the files: none if
// the rig has no calibration.camera. Throws InputError for bad input.
std::vector<std::string> simulate_camera_calibration(const Rig& rig, const std::string& out_folder,
                                                     const SimulateOptions& options,
                                                     Progress* progress);

}  // namespace scattermeter::apps
