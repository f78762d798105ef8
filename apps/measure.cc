#include "apps/measure.h"

#include <algorithm>

#include "apps/instrument.h"
#include "apps/rig_inputs.h"
#include "apps/shot_folder.h"
#include "apps/shot_source.h"
#include "apps/stopwatch.h"

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

Measurement measure(const Rig& rig, const std::string& shots_folder,
                    const MeasureOptions& options) {
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  const ShotFolder folder = match_shots(rig, shots_folder);
  const ObjectScenes scenes = open_objects(rig);
  Instrument instrument(rig, scenes, options);
  watch.lap("geometry");
  Measurement out = instrument.measure(shots_in_files(rig, folder.paths), watch);
  for (const std::string& name : folder.unlisted) {
    out.notes.push_back(name + ": not in the rig's list of shots, skipped");
  }
  std::vector<std::string> shot_files;
  for (const std::vector<std::string>& of_shot : folder.paths) {
    shot_files.insert(shot_files.end(), of_shot.begin(), of_shot.end());
  }
  out.inputs = rig_inputs(rig, scenes, shot_files);
  watch.lap("digests");
  watch.total();
  out.timing_s = timing_s;
  return out;
}

}  // namespace scattermeter::apps
