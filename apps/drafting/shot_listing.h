// What the raws of a folder say of themselves.
#pragma once

#include <string>
#include <vector>

namespace scattermeter::apps {

struct ListedShot {
  std::string file;
  double exposure_s = 0, iso = 0, f_number = 0;  // 0: not in the file
};

struct ShotListing {
  std::string model;  // of the camera
  int width_px = 0, height_px = 0;
  std::vector<ListedShot> shots;     // by name
  std::vector<std::string> skipped;  // files that are no raws: "name: why"
};

// Reads all files of the folder, without those beginning with a dot. Throws InputError when there
// is no folder, when no file in it is a raw that can be read, and for raws of different cameras or
// sizes.
ShotListing list_shots(const std::string& folder);

}  // namespace scattermeter::apps
