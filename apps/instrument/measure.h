// Measuring: from a folder of raws and a rig to coefficients.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/instrument/row_precision.h"
#include "apps/rig/rig.h"
#include "core/base/progress.h"
#include "core/estimation/estimate.h"

namespace scattermeter::apps {

struct RigPlaces;  // rig_places.h

struct MeasureOptions {
  EstimateOptions estimate;
  std::optional<double> patch_size_mm;  // of every object; absent: the rig's, or chosen
  std::vector<std::string> materials;   // of the rig, only these; empty: all
  // Where reached with fewer rows by the dipole, the others are skipped; absent: all rows.
  std::optional<PrecisionGoal> goal;
  // Folder of the decoded shots (capture/shots/shot_cache.h); empty: no cache.
  std::string cache_folder;
  // Folder of the paths of transport (atlas_folder.h); empty: they are not kept.
  std::string atlas_folder;
};

// A shot that was merged from several files. Samples are those on whole patches of the object.
struct MergedBracket {
  struct File {
    std::string file;
    double exposure_s = 0;                       // the true one, if known
    std::array<std::size_t, kRgb> samples = {};  // of the shot that it contributes to
    ExposureDeparture departure = {};            // of its light from that of the other files
  };
  std::string shot;  // the first file
  std::vector<File> files;
  std::array<std::size_t, kRgb> samples = {};          // of the shot
  std::array<std::size_t, kRgb> samples_clipped = {};  // of these, clipped in all files
};

struct InputFile {
  std::string path;
  std::string sha256;
};

// Work that was skipped, as it was not requested or has no effect on the results.
struct Skipped {
  std::size_t shots_not_asked = 0;     // of the rig's other materials
  std::size_t channels_not_asked = 0;  // of the measured materials
  std::size_t shots_from_cache = 0;    // not decoded again
  std::size_t samples_outside = 0;     // of decoded frames, outside the object: not converted
  std::size_t patches_unseen = 0;      // of the objects' views: without a row
  std::size_t patches_unlit = 0;       // of objects under each light: c_k = 0
  std::size_t shadow_rays = 0;         // on convex objects
  std::size_t rows = 0;                // of the shots: beyond the goal
  std::size_t nuisances = 0;           // of the materials' channels: negligible
};

struct Measurement {
  std::string model;                                     // as requested
  std::vector<ChannelResult> results;                    // materials in the rig's order, R G B each
  std::vector<std::string> notes;                        // for the user: skipped files and similar
  std::vector<std::pair<std::string, double>> timing_s;  // stages in order, then "total"
  std::vector<InputFile> inputs;                         // rig, meshes, probes, shots
  std::vector<MergedBracket> brackets;                   // in the rig's order
  std::map<std::string, double> patch_size_mm;           // by object
  Skipped skipped;
  std::shared_ptr<const RigPlaces> places;  // where everything stood; null if not measured here
  bool any_refused() const;
};

// Measures the materials of the rig. Writes nothing except to the cache of the options. An entirely
// dark or clipped shot causes its material's channel to be refused, and affects nothing else.
// Throws InputError for bad input, including a material or channel that the rig does not have, and
// Cancelled if `progress` does.
Measurement measure(const Rig& rig, const std::string& shots_folder,
                    const MeasureOptions& options = {}, Progress* progress = nullptr);

}  // namespace scattermeter::apps
