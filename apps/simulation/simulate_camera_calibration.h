// The shots of a rig's calibration.camera.
#pragma once

#include <string>
#include <vector>

#include "apps/rig/rig.h"
#include "apps/simulation/simulate.h"
#include "core/base/progress.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {

// Expected counts above black of a board in the world's plane z = 0, its origin in the world's, as
// the view shows it; else as the next. where, file: for messages.
std::vector<float> board_counts(const Rig& rig, const CameraView& view,
                                const calib::CalibrationBoard& board, const std::string& where,
                                const std::string& file);

// Expected counts above black of one board shot, each pixel in the channel of its filter: white in
// full light (apps/simulation/board_signal.h) reaches 0.7 of the range in the channel that the
// camera answers to most, the others in the proportion of its responsivity. Throws InputError where
// the board is behind the camera or out of the frame.
std::vector<float> board_shot_counts(const Rig& rig, const calib::BoardShot& shot);

// Writes the shots into `out_folder` (which exists); the paths of the files. None where the rig has
// no calibration.camera. Throws InputError for bad input.
std::vector<std::string> simulate_camera_calibration(const Rig& rig, const std::string& out_folder,
                                                     const SimulateOptions& options,
                                                     Progress* progress);

}  // namespace scattermeter::apps
