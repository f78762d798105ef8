// The main job: a folder of raws and a rig in, coefficients out.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/rig.h"
#include "calib/pose.h"
#include "core/estimate.h"

namespace scattermeter::apps {

enum class Model { kDipole, kPaper };

struct MeasureOptions {
  Model model = Model::kDipole;
  std::optional<double> patch_size_mm;  // of every object; else the rig's, else chosen
  bool quiet = false;
};

struct ChannelResult {
  std::string material;
  char channel;  // 'R', 'G', 'B'
  double eta_int_over_ext;
  Estimate estimate;
  std::vector<std::string> shots;  // file names that took part
  bool refused() const { return !estimate.reasons.empty(); }
};

struct InputFile {
  std::string path;
  std::string sha256;
};

struct Measurement {
  Model model = Model::kDipole;
  std::vector<ChannelResult> results;                    // materials in the rig's order, R G B each
  std::vector<std::string> notes;                        // for the user: skipped files and the like
  std::vector<std::pair<std::string, double>> timing_s;  // stages in order, then "total"
  std::vector<InputFile> inputs;                         // rig, meshes, probes, shots
  std::map<std::string, double> patch_size_mm;           // by object
  bool any_refused() const;
};

const char* model_name(Model model);

// Throws InputError for bad input; nothing is written. A shot that is dark or clipped as a whole
// refuses its material's channel and spoils nothing else.
Measurement measure(const Rig& rig, const std::string& shots_folder, const MeasureOptions& options);

}  // namespace scattermeter::apps
