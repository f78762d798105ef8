#include "apps/simulation/simulate_camera_calibration.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "apps/simulation/board_signal.h"
#include "apps/simulation/chosen_exposure.h"
#include "capture/sensor/virtual_sensor.h"
#include "core/base/input_error.h"
#include "core/base/progress.h"
#include "core/camera/cfa_samples.h"

namespace scattermeter::apps {
namespace {

constexpr double kWhiteOfRange = 0.7;

TriangleMesh board_outline(const calib::CalibrationBoard& board) {
  TriangleMesh mesh;
  const double w = board.squares_x * board.square_mm;
  const double h = board.squares_y * board.square_mm;
  mesh.vertices_mm = {{0, 0, 0}, {w, 0, 0}, {w, h, 0}, {0, h, 0}};
  return mesh;
}

// Counts of white in full light, per phase.
std::array<float, 4> white_counts(const Scene& scene) {
  const double range = kWhiteOfRange * capture::VirtualSensor(scene, {}, false).range_counts();
  const std::array<double, 3> responsivity =
      scene.camera.responsivity.value_or(std::array<double, 3>{1, 1, 1});
  const double most = *std::max_element(responsivity.begin(), responsivity.end());
  std::array<float, 4> counts{};
  for (std::size_t p = 0; p < 4; ++p) {
    const auto c = static_cast<std::size_t>(scene.camera.sensor.cfa.phase[p]);
    counts[p] = static_cast<float>(range * responsivity[c] / most);
  }
  return counts;
}

}  // namespace

std::vector<float> board_shot_counts(const Rig& rig, const calib::BoardShot& shot) {
  const std::string where = rig.at(shot.line) + ": calibration.camera.shots";
  if (!shot.viewpoint) {
    throw InputError(where + ".position_mm",
                     "is missing: simulate needs the position of the camera for " + shot.file);
  }
  return board_counts(
      rig,
      {rig.scene.camera.intrinsics,
       look_at(shot.viewpoint->position_mm, shot.viewpoint->look_at_mm, shot.viewpoint->up)},
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
  const std::array<float, 4> white = white_counts(rig.scene);
  const auto width = static_cast<std::size_t>(rig.scene.camera.intrinsics.width_px);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    counts[i] *= white[cfa_phase(static_cast<int>(i % width), static_cast<int>(i / width))];
  }
  return counts;
}

std::vector<std::string> simulate_camera_calibration(const Rig& rig, const std::string& out_folder,
                                                     const SimulateOptions& options,
                                                     Progress* progress) {
  std::vector<std::string> paths;
  if (!rig.calibration.camera) return paths;
  const std::vector<calib::BoardShot>& shots = rig.calibration.camera->shots;
  const capture::VirtualSensor sensor(rig.scene, rig.truth.sensor, options.noise);
  ProgressStage stage(progress, "board", shots.size());
  for (const calib::BoardShot& shot : shots) {
    paths.push_back((std::filesystem::path(out_folder) / shot.file).string());
    sensor.write(paths.back(), board_shot_counts(rig, shot),
                 rig.scene.camera.exposure_s.value_or(kDefaultExposure_s),
                 capture::VirtualSensor::stream(options.seed, shot.file));
    stage.step();
  }
  return paths;
}

}  // namespace scattermeter::apps
