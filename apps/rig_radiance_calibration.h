// A rig's calibration.radiance: dark frames, flats, exposure series, white reference, brackets,
// glare.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/yaml_field.h"
#include "calib/white_plane.h"

namespace scattermeter::apps {

struct PixelRect {
  int x, y, width, height;
};

struct RadianceShot {
  std::string file;
  std::optional<double> exposure_s;  // simulate only
  // Of flats: how bright the field was made, against flat_radiance. Only `simulate` takes it as a
  // number; flats of one value have one light. Several break what times and linearity share.
  double lamp = 1;
  int line = 0;
};

// A matt white plane of known albedo under one LED, seen by the rig's camera.
struct RigWhite {
  std::vector<RadianceShot> shots;  // several: an exposure bracket
  std::string light;
  calib::WhitePlane plane;
  int line = 0;
};

// A bright patch beside black traps, the rest of the frame dark.
struct RigGlare {
  std::vector<RadianceShot> shots;
  std::vector<PixelRect> traps_px;     // from where no light comes
  std::optional<PixelRect> bright_px;  // simulate only, and the next
  std::array<double, 3> bright_radiance_W_per_mm2_sr{};
  double relative_std = 0;  // of the model, on top of what the traps show
  int line = 0;
};

struct RigRadianceCalibration {
  std::vector<RadianceShot> dark;
  std::vector<RadianceShot> flats;
  std::optional<std::array<double, 3>> flat_radiance_W_per_mm2_sr;  // simulate only
  std::optional<RigWhite> white;
  std::optional<RigGlare> glare;
  int line = 0;
};

// Throws InputError with file, line, field and value. That white.light is a light of the rig is
// left to its users.
RigRadianceCalibration read_radiance_calibration(const YamlField& field,
                                                 const std::string& rig_path);

}  // namespace scattermeter::apps
