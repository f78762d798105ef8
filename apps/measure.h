// The main job: a folder of raws and a rig in, coefficients out.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/rig.h"
#include "calib/pose.h"
#include "capture/exposure_departure.h"
#include "core/dipole_misfit.h"
#include "core/estimate.h"
#include "core/observation.h"
#include "core/sample_map.h"
#include "core/shot_agreement.h"
#include "core/smooth_reflectance.h"

namespace scattermeter::apps {

enum class Model { kAuto, kDipole, kPaper, kTransport };

struct MeasureOptions {
  Model model = Model::kDipole;
  std::optional<double> patch_size_mm;  // of every object; else the rig's, else chosen
  // Of transport: light paths of the last step for each light and view, at most. Where they run out
  // before the time does, the digits are the same on any machine.
  std::int64_t paths = 1'000'000'000;
  double time_limit_s = 50;  // of transport: per material and channel
  bool keep_rows = false;    // fill ChannelResult::rows
  // What is asked for; empty: all of it. Materials of the rig; letters of "RGB".
  std::vector<std::string> materials;
  std::string channels;
  // Folder that keeps decoded shots (apps/shot_cache.h); empty: none is kept, none is looked for.
  std::string cache_folder;
  bool quiet = false;
};

// What a shot shows and what the model makes of it, by row of its map (a patch), W/mm^2 or up to
// one factor as ChannelObservation. NaN in predicted and std where the row took no part.
struct ShotRows {
  std::string file;
  std::shared_ptr<const SampleMap> map;
  std::vector<float> observed;
  std::vector<float> predicted;
  std::vector<float> std;  // of observed
  std::vector<RowState> state;
};

// A shot measured alone.
struct ShotResult {
  std::string file;
  Estimate estimate;
};

struct ChannelResult {
  std::string material;
  char channel;  // 'R', 'G', 'B'
  double eta_int_over_ext;
  Model model = Model::kDipole;  // that answers
  Estimate estimate;
  std::vector<std::string> shots;  // file names that took part
  // Patches, summed over the shots, by what kept them out (index: RowState; kUsed: in use), and
  // those that the silhouette, a crease or another part of the object hides in part.
  std::array<std::size_t, kRowStates> patches_by_state{};
  std::size_t patches_partly_seen = 0;
  std::size_t nuisances_negligible = 0;  // left out of the dipole's fit (apps/task_image.h)
  // Dipole and transport.
  std::vector<ShotResult> singles;  // each shot alone; empty for a single shot
  ShotAgreement agreement;          // whether they tell the same
  // r(d) without the dipole, and whether the dipole fits it. Of transport's answer, too, where it
  // says why the dipole would not do.
  std::optional<SmoothReflectance> recovered;
  std::optional<DipoleMisfit> misfit;
  // Of transport only: what the dipole answers, and why --model auto did not leave it at that.
  std::optional<Estimate> dipole;
  std::string why_transport;
  std::vector<ShotRows> rows;  // by shot, where asked for and the model came to an end
  bool refused() const { return !estimate.reasons.empty(); }
};

// A shot that was merged from several files. Samples are those on whole patches of the object.
struct MergedBracket {
  struct File {
    std::string file;
    double exposure_s = 0;                       // true, as far as known
    std::array<std::size_t, kRgb> samples = {};  // that hold any part of it
    capture::ExposureDeparture departure = {};   // of its light from that of the others
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
  Model model = Model::kDipole;
  std::vector<ChannelResult> results;                    // materials in the rig's order, R G B each
  std::vector<std::string> notes;                        // for the user: skipped files and the like
  std::vector<std::pair<std::string, double>> timing_s;  // stages in order, then "total"
  std::vector<InputFile> inputs;                         // rig, meshes, probes, shots
  std::vector<MergedBracket> brackets;                   // in the rig's order
  std::map<std::string, double> patch_size_mm;           // by object
  Skipped skipped;
  bool any_refused() const;
};

const char* model_name(Model model);

// How far the dipole's answer lies from transport's.
struct DipoleDistance {
  double sigma_s_prime_relative = 0;
  double sigma_a_per_mm = 0;
};
// Empty where there are not two answers.
std::optional<DipoleDistance> dipole_distance(const ChannelResult& result);

// Throws InputError for bad input, and for a material or channel that the rig does not have;
// nothing is written but what the options' cache keeps. A shot that is dark or clipped as a whole
// refuses its material's channel and spoils nothing else.
Measurement measure(const Rig& rig, const std::string& shots_folder, const MeasureOptions& options);

}  // namespace scattermeter::apps
