#include "apps/measure.h"

#include <algorithm>

#include <fmt/core.h>
#include <fmt/format.h>

#include "apps/digest.h"
#include "apps/instrument.h"
#include "apps/rig_inputs.h"
#include "apps/shot_cache.h"
#include "apps/shot_folder.h"
#include "apps/shot_source.h"
#include "apps/stopwatch.h"
#include "core/input_error.h"

namespace scattermeter::apps {
bool Measurement::any_refused() const {
  return std::any_of(results.begin(), results.end(),
                     [](const ChannelResult& r) { return r.refused(); });
}

std::optional<DipoleDistance> dipole_distance(const ChannelResult& r) {
  if (!r.dipole || !r.dipole->converged || !r.estimate.converged) return std::nullopt;
  return DipoleDistance{
      r.dipole->sigma_s_prime_per_mm.value / r.estimate.sigma_s_prime_per_mm.value - 1.0,
      r.dipole->sigma_a_per_mm.value - r.estimate.sigma_a_per_mm.value};
}

const char* model_name(Model model) {
  switch (model) {
    case Model::kPaper:
      return "paper";
    case Model::kTransport:
      return "transport";
    default:
      return "dipole";
  }
}

namespace {

// The rig with the shots of these materials alone.
Rig with_materials(const Rig& rig, const std::vector<std::string>& wanted) {
  if (wanted.empty()) return rig;
  const std::vector<std::string> known = rig.materials();
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError(rig.path, fmt::format("shots: no shot is of material {} (there are: {})",
                                             name, fmt::join(known, ", ")));
    }
  }
  Rig out = rig;
  std::erase_if(out.shots, [&](const RigShot& shot) {
    return std::find(wanted.begin(), wanted.end(), shot.material) == wanted.end();
  });
  return out;
}

bool lists(const Rig& rig, const std::string& file) {
  return std::any_of(rig.shots.begin(), rig.shots.end(), [&](const RigShot& shot) {
    const std::vector<std::string> files = shot.files();
    return std::find(files.begin(), files.end(), file) != files.end();
  });
}

}  // namespace

Measurement measure(const Rig& whole, const std::string& shots_folder,
                    const MeasureOptions& options) {
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  const Rig rig = with_materials(whole, options.materials);
  const ShotFolder folder = match_shots(rig, shots_folder);
  const ObjectScenes scenes = open_objects(rig);
  Instrument instrument(rig, scenes, options);
  watch.lap("geometry");
  FileDigests digests;
  std::optional<ShotCache> cache;
  ShotSource source = shots_in_files(rig, folder.paths);
  if (!options.cache_folder.empty()) {
    cache.emplace(options.cache_folder);
    source.cache = &*cache;
    source.digests = &digests;
  }
  Measurement out;
  try {
    out = instrument.measure(source, watch);
  } catch (const InputError&) {
    if (cache) cache->forget();
    throw;
  }
  out.skipped.shots_not_asked = whole.shots.size() - rig.shots.size();
  for (const std::string& name : folder.unlisted) {
    if (lists(whole, name)) continue;
    out.notes.push_back(name + ": not in the rig's list of shots, skipped");
  }
  if (cache) {
    cache->remove_others();
    out.skipped.shots_from_cache = cache->found();
    if (const std::string problem = cache->problem(); !problem.empty()) {
      out.notes.push_back("decoded shots are not kept: " + problem);
    }
  }
  std::vector<std::string> shot_files;
  for (const std::vector<std::string>& of_shot : folder.paths) {
    shot_files.insert(shot_files.end(), of_shot.begin(), of_shot.end());
  }
  out.inputs = rig_inputs(rig, scenes, digests, shot_files);
  watch.lap("digests");
  watch.total();
  out.timing_s = timing_s;
  return out;
}

}  // namespace scattermeter::apps
