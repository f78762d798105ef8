// The main job: a folder of raws and a rig in, coefficients out.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/rig/rig.h"
#include "core/base/progress.h"
#include "core/estimation/estimate.h"

namespace scattermeter::apps {

struct MeasureOptions {
  EstimateOptions estimate;
  std::optional<double> patch_size_mm;  // of every object; else the rig's, else chosen
  std::vector<std::string> materials;   // of the rig, those that are measured; empty: all
  // Folder that keeps decoded shots (capture/shots/shot_cache.h); empty: none is kept, none is
  // looked for.
  std::string cache_folder;
};

// A shot that was merged from several files. Samples are those on whole patches of the object.
struct MergedBracket {
  struct File {
    std::string file;
    double exposure_s = 0;                       // true, as far as known
    std::array<std::size_t, kRgb> samples = {};  // that hold any part of it
    ExposureDeparture departure = {};            // of its light from that of the others
  };
  std::string shot;  // the first file
  std::vector<File> files;
  std::array<std::size_t, kRgb> samples = {};          // of the shot
  std::array<std::size_t, kRgb> samples_clipped = {};  // of these, in all files
};

struct InputFile {
  std::string path;
  std::string sha256;
};

// What was not done, since nothing asked for it or depended on it; the answers are the same.
struct Skipped {
  std::size_t shots_not_asked = 0;     // of the rig
  std::size_t channels_not_asked = 0;  // of materials, of those shots that were
  std::size_t shots_from_cache = 0;    // not decoded
  std::size_t samples_outside = 0;     // of decoded frames, beside the object: not converted
  std::size_t patches_unseen = 0;      // of the objects' views: no row
  std::size_t patches_unlit = 0;       // of objects under each light: c_k = 0, in no sum
  std::size_t shadow_rays = 0;         // on convex objects
  std::size_t nuisances = 0;           // of materials' channels, too small to count
};

struct Measurement {
  std::string model;                                     // as asked for
  std::vector<ChannelResult> results;                    // materials in the rig's order, R G B each
  std::vector<std::string> notes;                        // for the user: skipped files and the like
  std::vector<std::pair<std::string, double>> timing_s;  // stages in order, then "total"
  std::vector<InputFile> inputs;                         // rig, meshes, probes, shots
  std::vector<MergedBracket> brackets;                   // in the rig's order
  std::map<std::string, double> patch_size_mm;           // by object
  Skipped skipped;
  bool any_refused() const;
};

// Throws InputError for bad input, and for a material or channel that the rig does not have;
// Cancelled where `progress` says so. Nothing is written but what the options' cache keeps. A shot
// that is dark or clipped as a whole refuses its material's channel and spoils nothing else.
Measurement measure(const Rig& rig, const std::string& shots_folder,
                    const MeasureOptions& options = {}, Progress* progress = nullptr);

}  // namespace scattermeter::apps
