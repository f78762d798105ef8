#include "apps/instrument/calibration_inputs.h"

#include <filesystem>
#include <system_error>

#include <fmt/core.h>

#include "apps/rig/rig_camera_calibration.h"
#include "calib/pose/shot_pose.h"
#include "capture/files/file_kind.h"
#include "capture/sensor/radiance_calibration.h"
#include "capture/shots/raw_shot.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> listed_files(const calib::BoardShots& board_shots,
                                      const std::string& shots_folder) {
  if (!capture::is_folder(shots_folder)) {
    throw InputError(shots_folder, "is not the folder of the rig's shots");
  }
  std::vector<std::string> files;
  std::string missing;
  int first_line = 0;
  for (const calib::BoardShot& shot : board_shots.shots) {
    files.push_back((fs::path(shots_folder) / shot.file).string());
    if (capture::is_there(files.back())) continue;
    missing += (missing.empty() ? "" : ", ") + shot.file;
    if (first_line == 0) first_line = shot.line;
  }
  if (!missing.empty()) {
    throw InputError(board_shots.at(first_line) + ": calibration.camera.shots.file",
                     "listed, but not in the folder " + shots_folder + ": " + missing);
  }
  return files;
}

calib::FramePose frame_pose(const Rig& rig) {
  if (!rig.pose.charuco) {
    return {[&rig](const capture::RawFrame&, const std::string&) {
              return calib::pose_from_points(rig.scene, rig.pose);
            },
            true};
  }
  return {[&rig](const capture::RawFrame& frame, const std::string& file) {
            return calib::pose_from_board(rig.scene, rig.pose, frame, file);
          },
          false};
}

calib::PriorLed prior_led(const SceneLight& light) {
  const LedLight& led = *light.led();
  return {light.name,       led.led,          led.position_std_mm,
          led.axis_std_rad, led.exponent_std, led.intensity_relative_std,
          led.calibrated};
}

}  // namespace

calib::CalibrateCameraOptions camera_calibration_input(const std::string& rig_path,
                                                       const std::string& shots_folder) {
  const RigCameraToCalibrate rig = read_camera_to_calibrate(rig_path);
  calib::CalibrateCameraOptions options;
  options.shots = listed_files(rig.calibration, shots_folder);
  options.board = rig.calibration.board;
  options.board_std_mm = rig.calibration.board_std_mm;
  options.max_megapixels = rig.max_megapixels;
  options.camera = rig.model;
  options.width_px = rig.width_px;
  options.height_px = rig.height_px;
  return options;
}

calib::LedCalibrationInput led_calibration_input(const Rig& rig) {
  if (!rig.calibration.led) {
    throw InputError(rig.path, "calibration.led: is missing; it lists spheres, planes and shots");
  }
  calib::LedCalibrationInput input;
  input.shots = *rig.calibration.led;
  for (const SceneLight& light : rig.scene.lights) {
    if (light.led() != nullptr) input.leds.push_back(prior_led(light));
  }
  input.intrinsics = rig.scene.camera.intrinsics;
  input.pose = frame_pose(rig);
  input.responsivity_counts_mm2_sr_per_W_s = rig.scene.camera.responsivity;
  input.noise = rig.scene.camera.sensor.noise;
  if (rig.decoding.radiance) input.correction = rig.decoding.radiance->correction;
  return input;
}

calib::LedFrames led_frames_in(const Rig& rig, const std::string& shots_folder) {
  return [&rig, shots_folder](std::size_t i) {
    const calib::LedCalibrationShots& led = *rig.calibration.led;
    const calib::LedCalibrationShot& shot = led.shots.at(i);
    const fs::path path = fs::path(shots_folder) / shot.file;
    std::error_code error;
    if (!fs::exists(path, error)) {
      throw InputError(shots_folder, fmt::format("{} is missing, but listed in {}", shot.file,
                                                 led.at(shot.line)));
    }
    return capture::open_shot(rig.scene, rig.decoding, path.string());
  };
}

calib::RadianceCalibrationInput radiance_calibration_input(const Rig& rig) {
  if (!rig.calibration.radiance) {
    throw InputError(rig.path + ": calibration.radiance", "is missing; it lists the shots");
  }
  calib::RadianceCalibrationInput input;
  input.shots = *rig.calibration.radiance;
  if (input.shots.white) input.white_led = prior_led(rig.scene.light(input.shots.white->light));
  input.intrinsics = rig.scene.camera.intrinsics;
  input.pose = frame_pose(rig);
  return input;
}

calib::RadianceFrames radiance_frames_in(const Rig& rig, const std::string& shots_folder) {
  return [&rig, shots_folder](const calib::RadianceShot& shot) {
    return capture::open_shot(rig.scene, rig.decoding,
                              (fs::path(shots_folder) / shot.file).string());
  };
}

}  // namespace scattermeter::apps
