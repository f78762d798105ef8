#include "apps/simulate_camera_calibration.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "apps/board_signal.h"
#include "apps/progress.h"
#include "apps/virtual_sensor.h"
#include "capture/tone_curve.h"
#include "core/cfa_samples.h"
#include "core/input_error.h"

namespace scattermeter::apps {
namespace {

constexpr double kWhiteOfRange = 0.7;
constexpr double kBoardExposure_s = 0.1;  // stated where the rig has none

TriangleMesh board_outline(const calib::CalibrationBoard& board) {
  TriangleMesh mesh;
  const double w = board.squares_x * board.square_mm;
  const double h = board.squares_y * board.square_mm;
  mesh.vertices_mm = {{0, 0, 0}, {w, 0, 0}, {w, h, 0}, {0, h, 0}};
  return mesh;
}

// Counts of white in full light, per phase.
std::array<float, 4> white_counts(const RigCamera& camera) {
  const RigSensor& sensor = camera.sensor;
  const double top = sensor.nef_lossy_curve
                         ? std::min<double>(sensor.white_counts, capture::nef_lossy_curve().back())
                         : sensor.white_counts;
  const double range = kWhiteOfRange * (top - *std::max_element(sensor.black_counts.begin(),
                                                                sensor.black_counts.end()));
  std::array<double, 3> answer = camera.responsivity.value_or(std::array<double, 3>{1, 1, 1});
  const double most = *std::max_element(answer.begin(), answer.end());
  std::array<float, 4> counts{};
  for (std::size_t p = 0; p < 4; ++p) {
    counts[p] =
        static_cast<float>(range * answer[static_cast<std::size_t>(sensor.cfa.phase[p])] / most);
  }
  return counts;
}

}  // namespace

std::vector<float> board_shot_counts(const Rig& rig, const RigBoardShot& shot) {
  const std::string where = rig.at(shot.line) + ": calibration.camera.shots";
  if (!shot.place) {
    throw InputError(where + ".position_mm",
                     "is missing: simulate needs the camera's place of " + shot.file);
  }
  return board_counts(rig,
                      {rig.camera.intrinsics,
                       look_at(shot.place->position_mm, shot.place->look_at_mm, shot.place->up)},
                      rig.calibration.camera->board, where, shot.file);
}

std::vector<float> board_counts(const Rig& rig, const CameraView& view,
                                const calib::CalibrationBoard& board, const std::string& where,
                                const std::string& file) {
  const ViewCheck check = check_view(view, board_outline(board));
  if (!check.in_front || !check.in_frame || !(view.center_in_world_mm().z() > 0)) {
    throw InputError(where, "the board is not in view of " + file +
                                ", or seen from behind (its print faces +z)");
  }
  std::vector<float> counts = board_signal(view, board);
  const std::array<float, 4> white = white_counts(rig.camera);
  const auto width = static_cast<std::size_t>(rig.camera.intrinsics.width_px);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    counts[i] *= white[cfa_phase(static_cast<int>(i % width), static_cast<int>(i / width))];
  }
  return counts;
}

std::vector<std::string> simulate_camera_calibration(const Rig& rig, const std::string& out_folder,
                                                     const SimulateOptions& options) {
  std::vector<std::string> paths;
  if (!rig.calibration.camera) return paths;
  const std::vector<RigBoardShot>& shots = rig.calibration.camera->shots;
  const VirtualSensor sensor(rig, options.noise);
  Progress progress("board", static_cast<int>(shots.size()), options.quiet);
  for (const RigBoardShot& shot : shots) {
    paths.push_back((std::filesystem::path(out_folder) / shot.file).string());
    sensor.write(paths.back(), board_shot_counts(rig, shot),
                 rig.camera.exposure_s.value_or(kBoardExposure_s),
                 VirtualSensor::stream(options.seed, shot.file));
    progress.step();
  }
  return paths;
}

}  // namespace scattermeter::apps
