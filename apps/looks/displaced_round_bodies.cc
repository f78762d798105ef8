#include "apps/looks/displaced_round_bodies.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "apps/looks/first_look.h"
#include "apps/looks/outline_finding.h"
#include "calib/pose/outline_causes.h"
#include "calib/pose/outline_contour.h"
#include "calib/pose/outline_look.h"

namespace scattermeter::apps {
namespace {

// Of a body in a shot with its own pose; absent unless the shot shows it displaced. A quick look
// sees the limb, which is dark, too far in, but light outside the predicted outline is the body's.
std::optional<Finding> displaced_in(const Rig& rig, const ObjectScene& object,
                                    const ObservedShot& shot, const capture::RawFrame& frame) {
  constexpr double kLimb_cells = 2.0;
  constexpr double kOutside = 0.2;  // of the points
  const CameraIntrinsics& lens = rig.scene.camera.intrinsics;
  const int cell_px = calib::outline_cell_px(lens.width_px);
  const std::vector<calib::ContourPoint> contour =
      calib::contour_points(*object.rays, lens, shot.pose.camera_from_world, cell_px);
  const calib::OutlineLook look = calib::look_at_outline(contour, frame, noise_in_force(rig));
  const auto outside = std::count_if(look.offsets.begin(), look.offsets.end(),
                                     [&](const auto& offset) { return offset.px > cell_px; });
  if (static_cast<double>(outside) < kOutside * static_cast<double>(contour.size())) return {};
  calib::OutlineOptions options;
  options.place_std_mm = object.stated->position_std_mm;
  options.turn_std_rad = options.place_std_mm / object.size_mm();
  options.scale_relative_std = object.stated->scale_relative_std;
  options.growth_std_px = kLimb_cells * cell_px;
  const calib::OutlineDiagnosis diagnosis = calib::explain_outlines(
      {{shot.stated->file, 0, &contour, look, Eigen::Vector3d::Zero()}}, lens, shot.pose,
      {object.stated->name}, {object.box.center_mm()}, options);
  if (diagnosis.agrees ||
      diagnosis.explanations.at(1).cause != calib::OutlineCause::kMeshDisplaced) {
    return {};
  }
  return outline_finding(diagnosis, object.stated->name);
}

}  // namespace

void find_displaced_round_bodies(const Rig& rig, const ObjectScenes& objects,
                                 const std::vector<ObservedShot>& shots,
                                 const std::set<std::size_t>& doubtful,
                                 const capture::FrameSource& frames, OutlineFindings& outlines) {
  std::map<std::string, std::optional<Finding>> displaced;  // absent: a shot says otherwise
  for (const ObservedShot& shot : shots) {
    const std::size_t idx = rig.scene.index_of(*shot.stated);
    const ObjectScene& object = objects.at(shot.stated->object);
    if (!outlines.unjudged.contains(shot.stated->object) || !doubtful.contains(idx)) continue;
    const auto [at, is_new] = displaced.try_emplace(shot.stated->object);
    if (!is_new && !at->second) continue;
    std::optional<Finding> own = displaced_in(rig, object, shot, frames(idx, 0));
    if (is_new || !own) at->second = std::move(own);
    if (at->second) at->second->shots.push_back(idx);
  }
  for (auto& [object, finding] : displaced) {
    if (finding) outlines.findings.push_back(std::move(*finding));
  }
}

void tell_of_displaced_round_bodies(const Rig& rig, const ObjectScenes& objects,
                                    const std::vector<ObservedShot>& shots,
                                    const capture::FrameSource& frames,
                                    std::vector<ChannelResult>& results) {
  const auto is_of = [](const ChannelResult& r, const std::string& file) {
    return is_fitted_and_refused(r) && uses(r, file);
  };
  OutlineFindings outlines;
  std::set<std::size_t> doubtful;
  for (const ObservedShot& shot : shots) {
    if (!objects.at(shot.stated->object).is_round) continue;
    outlines.unjudged.insert(shot.stated->object);
    if (std::any_of(results.begin(), results.end(),
                    [&](const ChannelResult& r) { return is_of(r, shot.stated->file); })) {
      doubtful.insert(rig.scene.index_of(*shot.stated));
    }
  }
  find_displaced_round_bodies(rig, objects, shots, doubtful, frames, outlines);
  for (const Finding& f : outlines.findings) {
    for (ChannelResult& r : results) {
      if (std::any_of(f.shots.begin(), f.shots.end(),
                      [&](std::size_t idx) { return is_of(r, rig.scene.shots[idx].file); })) {
        add_first_reason(f.sentence(), r);
      }
    }
  }
}

}  // namespace scattermeter::apps
