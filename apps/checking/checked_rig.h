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
#include "apps/looks/finding.h"
#include "apps/looks/outline_watch.h"
#include "apps/rig/rig.h"
#include "calib/led/led_check.h"
#include "calib/lens/camera_calibration_file.h"
#include "calib/pose/pose.h"
#include "calib/pose/silhouette_check.h"
#include "capture/sensor/background_level.h"
#include "capture/sensor/noise_curve.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

// Draws a small picture of a shot, as the bytes of a file.
using ShotPainter = std::function<std::string(const capture::RawFrame&, const CameraView&,
                                              const RayScene&, const SampleMap&)>;

struct CheckOptions {
  double max_pose_rms_px = 1.0;
  double max_pose_outlier_percent = 25.0;
  double max_lens_rms_px = 0.5;
  double max_clipped_percent = 1.0;     // of the samples on the object
  double max_bracket_percent = 1.0;     // between the exposures of a bracket
  double min_brightest_snr = 30.0;      // of a patch
  double max_noise_percent = 30.0;      // scatter of samples above the noise model's variance
  double max_background_percent = 1.0;  // of the brightest patch
  double max_black_drift_read_noises = 0.5;
  double max_power_percent = 5.0;             // of a shot's light, relative to the joint model's
  double max_drift_percent = 5.0;             // of an LED, from its first shot to its last
  double max_even_percent = 2.0;              // uniform light, of the shot's mean
  double max_residual_percent = 10.0;         // of the image, relative to the joint model
  double max_material_spread_percent = 10.0;  // of sigma_s' of a material's shots, see identity
  double max_led_place_mm = 0.5;   // plus three times the standard deviation stated by the rig
  double max_outline_px = 1.0;     // of a shot's mean shift
  double max_plane_percent = 2.0;  // of the white plane under an LED
  double max_plane_ambient_percent = 1.0;  // other light on it, of an LED's
  double max_led_power_percent = 2.0;      // of an LED, from its calibration shots
  double max_dark_counts = 2.0;            // of a dark frame, above the file's black
  double least_stds = 5.0;  // standard deviations below which a departure from the model passes
  ShotPainter draw_shot;    // for a page; empty: none is drawn
  Progress* progress = nullptr;
};

// What a shot's file contains besides its samples on the object.
struct CheckedFrame {
  std::array<double, 4> black_counts{};
  capture::BackgroundLevel background;  // only of shots without a board
  std::array<std::vector<capture::NoisePoint>, kRgb> noise;
  std::string png;  // by CheckOptions::draw_shot
};

// What the opened shots refer to.
struct CheckedGeometry {
  Rig stated;  // with the positions of pieces that were found
  // The same with larger uncertainties of the LED positions, so that the shots determine them.
  Rig rig;
  ObjectScenes objects;
  std::unique_ptr<LitObjects> lit;
};

struct CheckedRig {
  const Rig& rig;  // geometry->stated
  CheckOptions options;
  std::optional<PoseResult> shared_pose;  // from the rig's points
  std::vector<ObservedShot> shots;        // in the rig's order
  std::vector<CheckedFrame> frames;       // in the same order
  CheckFit fit;
  std::vector<std::string> notes;
  std::shared_ptr<const CheckedGeometry> geometry;
  std::string folder;  // of the shots
  // Present if camera.intrinsics names a file.
  std::optional<calib::CameraCalibrationFile> lens;
  std::optional<calib::SilhouetteCheck> outline;
  std::vector<calib::LedCheck> leds;  // those whose calibration shots are all in the folder
  // What `measure` would see before any fit, of bodies whose outlines can be judged; for a board in
  // every shot without a diagnosis.
  std::optional<OutlineFindings> looks = {};

  // What is wrong according to the looks before any fit, the most probable first: `measure` refuses
  // these shots.
  std::vector<Finding> findings() const;

  CheckDetail of_shot(std::size_t shot_idx, double value) const;
  CheckDetail of_channel(std::size_t shot_idx, std::size_t channel, double value) const;
};

// Finds pieces whose position is not stated, opens all shots and fits the joint model (the dipole)
// to them. Throws InputError for anything that measure() would refuse to read.
CheckedRig open_checked_rig(const Rig& given, const std::string& shots_folder,
                            const CheckOptions& options);

}  // namespace scattermeter::apps
