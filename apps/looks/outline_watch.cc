#include "apps/looks/outline_watch.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <variant>

#include <fmt/core.h>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/looks/closer_look.h"
#include "apps/looks/other_outline.h"
#include "apps/looks/other_size.h"
#include "apps/looks/outline_finding.h"
#include "apps/looks/piece_look.h"
#include "apps/looks/scaled_piece.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {
namespace {

using calib::OutlineCause;

// Below this share of points that lie on one outline it is not judged: the background is bright, or
// too little of the object is lit.
constexpr double kLeastShare = 0.5;
constexpr int kLooksAgain = 2;
constexpr std::size_t kShotsAgain = 4;  // of each object

std::string not_judged(double share) {
  return fmt::format(
      "outlines are not judged: only {:.0f} % of their points are found where some position of the "
      "objects would put them; use a darker background, and light the objects from more sides",
      100.0 * share);
}

}  // namespace

OutlineWatch::OutlineWatch(const Rig& rig, const ObjectScenes& objects, const PoseResult& pose)
    : rig_(rig), objects_(objects), pose_(pose) {
  const CameraIntrinsics& lens = rig.scene.camera.intrinsics;
  for (const SceneObject& object : rig.scene.objects) {
    names_.push_back(object.name);
    const auto scene = objects.find(object.name);
    centers_mm_.push_back(scene == objects.end() ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                                                 : scene->second.box.center_mm());
    if (scene == objects.end() || scene->second.is_round) continue;
    contours_[object.name] = calib::contour_points(
        *scene->second.rays, lens, pose.camera_from_world, calib::outline_cell_px(lens.width_px));
  }
}

void OutlineWatch::look(std::size_t shot_idx, const capture::RawFrame& frame) {
  const auto contour = contours_.find(rig_.scene.shots.at(shot_idx).object);
  if (contour == contours_.end()) return;
  Seen seen{&contour->second, calib::look_at_outline(contour->second, frame, noise_in_force(rig_))};
  const std::lock_guard lock(mutex_);
  looks_[shot_idx] = std::move(seen);
}

std::map<std::size_t, std::vector<std::size_t>> OutlineWatch::shots_of_bodies(
    const Looks& looks) const {
  std::map<std::size_t, std::vector<std::size_t>> out;
  for (const auto& [idx, seen] : looks) out[body_of(idx)].push_back(idx);
  return out;
}

std::size_t OutlineWatch::body_of(std::size_t shot_idx) const {
  const auto at = std::find(names_.begin(), names_.end(), rig_.scene.shots.at(shot_idx).object);
  return static_cast<std::size_t>(at - names_.begin());
}

calib::OutlineDiagnosis OutlineWatch::explain(const Looks& looks,
                                              const std::vector<Eigen::Vector3d>& assumed_mm,
                                              std::vector<std::size_t>& looked_at) const {
  std::vector<calib::OutlineShot> shots;
  looked_at.clear();
  for (const auto& [idx, seen] : looks) {
    const std::size_t body = body_of(idx);
    shots.push_back({rig_.scene.shots[idx].file, static_cast<int>(body), seen.contour, seen.look,
                     assumed_mm[body]});
    looked_at.push_back(idx);
  }
  return calib::explain_outlines(shots, rig_.scene.camera.intrinsics, pose_, names_, centers_mm_,
                                 outline_options(rig_, objects_, pose_));
}

// Shots of another object than the stated one; they are taken out of the looks.
void OutlineWatch::find_other_objects(const capture::FrameSource& frames, Looks& looks,
                                      OutlineFindings& out) const {
  for (auto it = looks.begin(); it != looks.end();) {
    std::optional<Finding> finding =
        other_outline(rig_, objects_, pose_, contours_, it->first, it->second.look, frames);
    if (!finding) {
      ++it;
      continue;
    }
    out.findings.push_back(std::move(*finding));
    it = looks.erase(it);
  }
}

void OutlineWatch::find_unseen(Looks& looks, OutlineFindings& out) const {
  for (auto it = looks.begin(); it != looks.end();) {
    if (it->second.look.offsets.size() >= calib::kLeastOffsets) {
      ++it;
      continue;
    }
    out.notes.push_back(fmt::format(
        "{}: outline of {} not seen against a darker background, so pose and mesh are not checked",
        rig_.scene.shots[it->first].file, names_[body_of(it->first)]));
    it = looks.erase(it);
  }
}

// Looks again about the places of a first diagnosis, which is linear.
calib::OutlineDiagnosis OutlineWatch::look_again(const capture::FrameSource& frames,
                                                 const Looks& looks, calib::OutlineDiagnosis first,
                                                 std::vector<std::size_t>& looked_at) const {
  const CameraIntrinsics& lens = rig_.scene.camera.intrinsics;
  std::map<std::size_t, std::size_t> of_body;
  std::vector<std::size_t> idxs;
  for (const auto& [idx, seen] : looks) {
    if (of_body[body_of(idx)]++ < kShotsAgain) idxs.push_back(idx);
  }
  std::vector<capture::RawFrame> pictures(idxs.size());
  tbb::parallel_for(std::size_t{0}, idxs.size(),
                    [&](std::size_t i) { pictures[i] = frames(idxs[i], 0); });
  calib::OutlineDiagnosis out = std::move(first);
  for (int round = 0; round < kLooksAgain && !out.agrees; ++round) {
    std::vector<Eigen::Vector3d> assumed(names_.size(), Eigen::Vector3d::Zero());
    for (const calib::OutlineExplanation& e : out.explanations) {
      if (e.cause == OutlineCause::kMeshDisplaced) assumed[e.which] = e.value;
    }
    std::map<std::string, std::vector<calib::ContourPoint>> contours;
    Looks again;
    for (std::size_t i = 0; i < idxs.size(); ++i) {
      const std::size_t idx = idxs[i];
      const std::size_t body = body_of(idx);
      const auto [at, is_new] = contours.try_emplace(names_[body]);
      if (is_new) {
        const Rigid3d moved =
            pose_.camera_from_world * Rigid3d{Eigen::Quaterniond::Identity(), assumed[body]};
        at->second = calib::contour_points(*objects_.at(names_[body]).rays, lens, moved,
                                           calib::outline_cell_px(lens.width_px));
      }
      again[idx] = {&at->second,
                    calib::look_at_outline(at->second, pictures[i], noise_in_force(rig_))};
      if (again[idx].look.offsets.size() < calib::kLeastOffsets) return out;
    }
    out = explain(again, assumed, looked_at);
  }
  return out;
}

// What the quick look leaves open, and where exactly the pieces stand that it shows elsewhere, is
// told by the careful search.
void OutlineWatch::look_closely(const capture::FrameSource& frames, const Looks& looks,
                                OutlineFindings& out) const {
  for (auto& [body, idxs] : shots_of_bodies(looks)) {
    if (out.shifts.empty() && !calib::may_be_misplaced(*out.diagnosis, body)) continue;
    PieceLook look = look_at_piece(rig_, objects_, names_[body], pose_, std::move(idxs), frames);
    if (look.finding) {
      out.findings.push_back(std::move(*look.finding));
      out.diagnosis->agrees = false;
    } else if (look.moved) {
      out.moved[names_[body]] = std::move(*look.moved);
    }
  }
}

// One whose outline fits at another size than its mesh's, by its first shot.
bool OutlineWatch::find_other_sizes(const capture::FrameSource& frames, const Looks& looks,
                                    OutlineFindings& out) const {
  bool found = false;
  for (auto& [body, idxs] : shots_of_bodies(looks)) {
    std::optional<Finding> finding =
        other_size(objects_.at(names_[body]), rig_.scene.camera.intrinsics, pose_,
                   frames(idxs.front(), 0), noise_in_force(rig_));
    if (!finding) continue;
    finding->shots = std::move(idxs);
    out.findings.push_back(std::move(*finding));
    found = true;
  }
  return found;
}

void OutlineWatch::find_scaled_pieces(const capture::FrameSource& frames, const Looks& looks,
                                      OutlineFindings& out) const {
  for (const auto& [body, idxs] : shots_of_bodies(looks)) {
    const ObjectScene& object = objects_.at(names_[body]);
    const SizeLook seen = size_look(out.diagnosis->growth_px[body],
                                    looks.at(idxs.front()).look.cell_px, rig_, object, pose_);
    std::optional<Finding> finding;
    if (seems_scaled(seen)) {
      finding = scaled_piece(rig_, objects_, *object.stated, quick_place_std_mm(object), pose_,
                             frames, idxs);
    }
    if (finding) {
      out.findings.push_back(std::move(*finding));
      out.diagnosis->agrees = false;
    } else if (const double open = size_left_open(seen); open > 0.0) {
      out.sizes_open[names_[body]] = open;
      out.notes.push_back(size_note(names_[body], seen));
    }
  }
}

void OutlineWatch::conclude(const Looks& looks, OutlineFindings& out) const {
  const calib::OutlineDiagnosis& d = *out.diagnosis;
  if (d.agrees) {
    if (d.shifts.empty()) return;
    for (std::size_t b = 0; b < names_.size(); ++b) out.shifts[names_[b]] = d.shifts[b];
    out.notes.push_back(
        fmt::format("outline {} of where the pose puts it (± {:.1f}), within the stated "
                    "uncertainty: the search for the object's position begins there",
                    shift_phrase(d.shift_px), d.shift_std_px));
    return;
  }
  const calib::OutlineExplanation& best = d.explanations.at(1);
  const bool of_shot = best.cause == OutlineCause::kShotMoved;
  const bool of_mesh = !of_shot && best.cause != OutlineCause::kCamera;
  Finding finding =
      outline_finding(d, of_mesh ? names_[best.which] : "", board_distance_mm(rig_.pose, pose_));
  if (of_shot) {
    finding.shots = {out.looked_at[best.which]};
  } else {
    // All of them, not only those that were looked at again.
    for (const auto& [idx, look] : looks) {
      if (!of_mesh || body_of(idx) == best.which) finding.shots.push_back(idx);
    }
  }
  out.findings.push_back(finding);
}

// The quick look hardly tells how far along the line of sight a displaced object stands.
void OutlineWatch::say_exactly(const capture::FrameSource& frames, OutlineFindings& out) const {
  const calib::OutlineExplanation& best = out.diagnosis->explanations.at(1);
  if (best.cause != OutlineCause::kMeshDisplaced && best.cause != OutlineCause::kMeshMisplaced) {
    return;
  }
  Finding& told = out.findings.back();
  PieceLook exact = look_at_piece(rig_, objects_, names_[best.which], pose_, told.shots, frames);
  if (exact.finding) told = std::move(*exact.finding);
}

OutlineFindings OutlineWatch::findings(const capture::ShotSource& source) const {
  OutlineFindings out;
  const auto* frames = std::get_if<capture::FrameSource>(&source.open);
  for (const std::string& name : names_) {
    if (const auto object = objects_.find(name);
        object != objects_.end() && object->second.is_round)
      out.unjudged.insert(name);
  }
  Looks looks = looks_;
  find_unseen(looks, out);
  if (looks.empty() || frames == nullptr) return out;
  const std::vector<Eigen::Vector3d> nowhere(names_.size(), Eigen::Vector3d::Zero());
  out.diagnosis = explain(looks, nowhere, out.looked_at);
  if (!out.diagnosis->agrees) {
    find_other_objects(*frames, looks, out);
    if (looks.empty()) return out;
    if (!out.findings.empty()) out.diagnosis = explain(looks, nowhere, out.looked_at);
    if (out.diagnosis->explanations.at(1).cause != OutlineCause::kShotMoved) {
      out.diagnosis = look_again(*frames, looks, *out.diagnosis, out.looked_at);
    }
  }
  const std::vector<double>& fitting = out.diagnosis->fitting_share;
  const double share = std::accumulate(fitting.begin(), fitting.end(), 0.0) /
                       std::max<double>(1.0, static_cast<double>(fitting.size()));
  if (share < kLeastShare) {
    if (!find_other_sizes(*frames, looks, out)) out.notes.push_back(not_judged(share));
    return out;
  }
  const std::size_t others = out.findings.size();
  const std::size_t notes = out.notes.size();
  conclude(looks, out);
  if (out.findings.size() > others &&
      closer_look_agrees(rig_, objects_, pose_, *frames, out.findings.back().shots)) {
    out.findings.pop_back();
    out.diagnosis->agrees = true;
  }
  if (out.findings.size() > others) {
    say_exactly(*frames, out);
  } else {
    find_scaled_pieces(*frames, looks, out);
    if (out.findings.size() == others) look_closely(*frames, looks, out);
    if (out.findings.size() > others) {  // nothing lies within what is stated
      out.notes.resize(notes);
      out.shifts.clear();
      out.moved.clear();
    }
  }
  return out;
}

}  // namespace scattermeter::apps
