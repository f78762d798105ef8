// Shots for the radiance calibration of a camera: dark frames, flats, a white reference and glare.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "calib/led/white_plane.h"
#include "core/camera/pixel_rect.h"

namespace scattermeter::calib {

struct RadianceShot {
  std::string file;
  std::optional<double> exposure_s;  // for simulation only
  // Flats only: brightness of the field relative to flat_radiance_W_per_mm2_sr. Simulation uses the
  // value; calibration only requires that flats of one value have the same light. Several values
  // separate the exposure times from the linearity.
  double lamp = 1;
  int line = 0;  // in RadianceCalibrationShots::path
};

// A matt white plane of known albedo under one LED.
struct WhiteReference {
  std::vector<RadianceShot> shots;  // one shot, or an exposure bracket
  std::string light;                // name of the LED
  WhitePlane plane;
  int line = 0;
};

// A bright patch beside black traps, the rest of the frame dark.
struct GlareTarget {
  std::vector<RadianceShot> shots;
  std::vector<PixelRect> traps_px;                       // regions that emit no light
  std::optional<PixelRect> bright_px;                    // for simulation only
  std::array<double, 3> bright_radiance_W_per_mm2_sr{};  // for simulation only
  double relative_std = 0;  // model error, in addition to the scatter between the traps
  int line = 0;
};

struct RadianceCalibrationShots {
  std::vector<RadianceShot> dark;
  std::vector<RadianceShot> flats;
  std::optional<std::array<double, 3>> flat_radiance_W_per_mm2_sr;  // for simulation only
  std::optional<WhiteReference> white;
  std::optional<GlareTarget> glare;
  std::string path;  // file that lists the shots, for messages
  int line = 0;

  // "rig.yaml:12" for messages.
  std::string at(int line_number) const { return path + ":" + std::to_string(line_number); }
};

}  // namespace scattermeter::calib
