// The opened shots and the joint fit that `check` examines.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/checking/check_fit.h"
#include "apps/checking/check_item.h"
#include "apps/instrument/measure.h"
#include "apps/instrument/open_shots.h"
#include "apps/rig/rig.h"
#include "calib/led/led_check.h"
#include "calib/lens/camera_calibration_file.h"
#include "calib/pose/pose.h"
#include "calib/pose/silhouette_check.h"
#include "capture/sensor/background_level.h"
#include "capture/sensor/noise_curve.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

struct CheckOptions {
  double max_pose_rms_px = 1.0;
  double max_pose_outlier_percent = 25.0;
  double max_lens_rms_px = 0.5;
  double max_clipped_percent = 1.0;     // of the samples on the object
  double max_bracket_percent = 1.0;     // of an exposure's light, from the others of its bracket
  double min_brightest_snr = 30.0;      // of a patch
  double max_noise_percent = 30.0;      // scatter of samples above the noise model's variance
  double max_background_percent = 1.0;  // of the brightest patch
  double max_black_drift_read_noises = 0.5;
  double max_power_percent = 5.0;             // of a shot's light, from the joint model's
  double max_drift_percent = 5.0;             // of an LED, from its first shot to its last
  double max_even_percent = 2.0;              // even light, of the shot's mean
  double max_residual_percent = 10.0;         // of the image, from the joint model
  double max_material_spread_percent = 10.0;  // of sigma_s' of a material's shots, see identity
  double max_led_place_mm = 0.5;              // beside three times what the rig owns up to
  double max_outline_px = 1.0;                // of a shot's mean shift
  double max_plane_percent = 2.0;             // of the white plane under an LED
  double max_plane_ambient_percent = 1.0;     // of an LED's light on it, of other light
  double max_led_power_percent = 2.0;         // of an LED, from its calibration shots
  double max_dark_counts = 2.0;               // of a dark frame, above the file's black
  double least_stds = 5.0;  // deviations from which on a departure from the model counts
  // Draws a shot in small, as bytes, for a page; empty: none is drawn.
  std::function<std::string(const capture::RawFrame&, const CameraView&, const RayScene&,
                            const SampleMap&)>
      draw_shot;
  Progress* progress = nullptr;
};

// What a shot's file says besides its samples on the object.
struct CheckedFrame {
  std::array<double, 4> black_counts{};
  capture::BackgroundLevel background;  // of shots without a board
  std::array<std::vector<capture::NoisePoint>, kRgb> noise;
  std::string png;  // by CheckOptions::draw_shot
};

// What the opened shots refer to.
struct CheckedGeometry {
  // The rig with LEDs whose places are known less well, so that the shots say where they are.
  Rig rig;
  ObjectScenes scenes;
  std::unique_ptr<LitObjects> library;
};

struct CheckedRig {
  const Rig& rig;
  CheckOptions options;
  std::optional<PoseResult> shared_pose;  // from the rig's points
  std::vector<ObservedShot> shots;        // in the rig's order
  std::vector<CheckedFrame> frames;       // of the same
  CheckFit fit;
  std::vector<std::string> notes;
  std::shared_ptr<const CheckedGeometry> geometry;
  std::string folder;  // of the shots
  // With camera.intrinsics in a file of its own.
  std::optional<calib::CameraCalibrationFile> lens;
  std::optional<calib::SilhouetteCheck> outline;
  std::vector<calib::LedCheck> leds;  // whose shots of calibration.led are all there

  CheckDetail of_shot(std::size_t shot_idx, double value) const;
  CheckDetail of_channel(std::size_t shot_idx, std::size_t channel, double value) const;
};

// Opens all shots and fits the joint model (the dipole) to them. What is kept refers to `rig`,
// which must outlive it. Throws InputError for what measure would refuse to read.
CheckedRig open_checked_rig(const Rig& rig, const std::string& shots_folder,
                            const CheckOptions& options);

}  // namespace scattermeter::apps
