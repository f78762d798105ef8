#include "apps/instrument/measure.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <thread>

#include <fmt/core.h>
#include <fmt/format.h>

#include "apps/instrument/instrument.h"
#include "apps/instrument/rig_inputs.h"
#include "apps/looks/piece_places.h"
#include "apps/rig/open_objects.h"
#include "apps/rig/rig_led_agreement.h"
#include "apps/rig/rig_placeholders.h"
#include "calib/lens/lens_of_points.h"
#include "calib/pose/shot_pose.h"
#include "capture/files/digest.h"
#include "capture/shots/shot_cache.h"
#include "capture/shots/shot_folder.h"
#include "capture/shots/shot_source.h"
#include "core/base/input_error.h"
#include "core/base/nearest_name.h"
#include "core/base/progress.h"
#include "core/base/stopwatch.h"

namespace scattermeter::apps {
bool Measurement::any_refused() const {
  return std::any_of(results.begin(), results.end(),
                     [](const ChannelResult& r) { return r.refused(); });
}

namespace {

// The rig with only the shots of these materials.
Rig with_materials(const Rig& rig, const std::vector<std::string>& wanted) {
  if (wanted.empty()) return rig;
  const std::vector<std::string> known = rig.scene.materials();
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError(rig.path,
                       fmt::format("shots: no shot is of material {}{} (there are: {})", name,
                                   did_you_mean(name, known), fmt::join(known, ", ")));
    }
  }
  Rig out = rig;
  std::erase_if(out.scene.shots, [&](const SceneShot& shot) {
    return std::find(wanted.begin(), wanted.end(), shot.material) == wanted.end();
  });
  return out;
}

bool lists(const Rig& rig, const std::string& file) {
  return std::any_of(rig.scene.shots.begin(), rig.scene.shots.end(), [&](const SceneShot& shot) {
    const std::vector<std::string> files = shot.files();
    return std::find(files.begin(), files.end(), file) != files.end();
  });
}

// The shots that the cache cannot have, where they are fewer than the processor's cores: the cores
// would idle while the geometry is prepared. Of more shots none.
std::vector<std::size_t> few_new_shots(const std::vector<std::vector<std::string>>& paths,
                                       const std::optional<capture::ShotCache>& cache) {
  const auto newest = cache ? cache->newest() : std::nullopt;
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::error_code error;
    const auto time = std::filesystem::last_write_time(paths[i].front(), error);
    if (!error && (!newest || time > *newest)) out.push_back(i);
  }
  if (out.size() >= std::thread::hardware_concurrency()) out.clear();
  return out;
}

}  // namespace

Measurement measure(const Rig& whole, const std::string& shots_folder,
                    const MeasureOptions& options, Progress* progress) {
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  require_radiance_of_leds(whole);
  Rig rig = with_materials(whole, options.materials);
  const std::string lens =
      calib::take_points_and_lens(rig.scene, rig.decoding, shots_folder, rig.pose);
  const capture::ShotFolder folder =
      capture::match_shots(rig.scene, calibration_files(rig), shots_folder);
  std::vector<std::string> places = place_pieces(rig, shots_folder, progress);
  std::optional<capture::ShotCache> cache;
  if (!options.cache_folder.empty()) cache.emplace(options.cache_folder);
  capture::FileDigests digests;
  capture::ShotSource source = capture::shots_in_files(rig.scene, rig.decoding, folder.paths);
  source = capture::begun(source, few_new_shots(folder.paths, cache));
  if (cache) {
    source.cache = &*cache;
    source.digests = &digests;
  }
  const ObjectScenes objects = open_objects(rig);
  Instrument instrument(rig, objects, options, progress);
  watch.lap("geometry");
  Measurement out;
  try {
    out = instrument.measure(source, watch);
  } catch (...) {
    if (cache) cache->forget();
    throw;
  }
  out.notes.insert(out.notes.begin(), places.begin(), places.end());
  if (!lens.empty()) out.notes.insert(out.notes.begin(), lens);
  if (out.any_refused()) tell_placeholders(rig.path, out.notes);
  out.skipped.shots_not_asked = whole.scene.shots.size() - rig.scene.shots.size();
  if (instrument.pose_of_points() && whole.pose.board_shot.empty()) {
    const std::string points = calib::left_out_points(*instrument.pose_of_points());
    if (!points.empty()) {
      out.notes.push_back(whole.at(whole.pose.line) +
                          ": pose: left out, because the other points " +
                          "contradict them: " + points + "; check their numbers");
    }
  }
  for (const std::string& name : folder.unlisted) {
    if (lists(whole, name)) continue;
    out.notes.push_back(name + ": not in the rig's list of shots, skipped");
  }
  if (cache) {
    cache->remove_others();
    out.skipped.shots_from_cache = std::min(cache->found(), source.shot_idxs.size());
    if (const std::string problem = cache->problem(); !problem.empty()) {
      out.notes.push_back("decoded shots are not kept: " + problem);
    }
  }
  std::vector<std::string> shot_files;
  for (const std::vector<std::string>& of_shot : folder.paths) {
    shot_files.insert(shot_files.end(), of_shot.begin(), of_shot.end());
  }
  out.inputs = rig_inputs(rig, objects, digests, shot_files);
  watch.lap("digests");
  watch.total();
  out.timing_s = timing_s;
  return out;
}

}  // namespace scattermeter::apps
