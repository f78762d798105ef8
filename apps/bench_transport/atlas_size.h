// bench atlas: what an atlas takes on disk and in memory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/progress.h"

namespace scattermeter::apps {

struct AtlasSizeOptions {
  std::vector<std::string> bodies = {"cube"};
  int rows = 2000;     // about, >= 100: patches that face the camera
  std::string folder;  // of the atlas; has to be new
  int image_width_px = 968;
  Progress* progress = nullptr;
};

struct AtlasSizeRow {
  std::string body;
  std::int64_t rows = 0;  // of one light and view
  int nodes = 0;          // for sigma_s' of 0.2 to 10 per mm
  double disk_bytes = 0;  // of all nodes
  // Growth of the program's memory with the nodes of one medium, and then with all of them.
  double medium_bytes = 0;
  double all_bytes = 0;
};

// Nodes with the fewest paths: their number changes no size.
std::vector<AtlasSizeRow> atlas_size(const AtlasSizeOptions& options);

// With what 10^5 rows would take, in proportion.
std::string atlas_size_table(const std::vector<AtlasSizeRow>& rows);
std::string atlas_size_csv(const std::vector<AtlasSizeRow>& rows);

}  // namespace scattermeter::apps
