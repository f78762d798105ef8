// Does the rig hold? The residual of every calibration against its limit.
#pragma once

#include <string>
#include <vector>

#include "apps/rig.h"

namespace scattermeter::apps {

struct CheckItem {
  std::string what;  // "pose", "noise POM_cube_1.dng R"
  double value = 0;
  double limit = 0;
  std::string unit;
  bool passed = false;
  std::string advice;  // what to do when it fails
};

struct CheckReport {
  std::vector<CheckItem> items;
  std::vector<std::string> notes;
  bool passed() const;
};

struct CheckOptions {
  double max_pose_rms_px = 1.0;
  double max_pose_outlier_share = 0.25;
  double max_clipped_percent = 1.0;  // of the samples on the object
  double min_brightest_snr = 30.0;   // of a patch
  double max_noise_ratio = 1.3;      // scatter of samples over the noise model
  bool quiet = false;
};

// Opens all shots. Throws InputError for what measure would refuse to read.
CheckReport check_rig(const Rig& rig, const std::string& shots_folder, const CheckOptions& options);

std::string check_table(const CheckReport& report);

}  // namespace scattermeter::apps
