#include "apps/watching/watched_shots.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "apps/looks/piece_places.h"
#include "apps/rig/open_objects.h"
#include "apps/watching/linked_file.h"
#include "calib/lens/lens_of_points.h"
#include "capture/files/file_kind.h"
#include "capture/shots/raw_shot.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace fs = std::filesystem;

WatchedShots::WatchedShots(const Rig& rig, const std::string& out_folder, ShotPainter paint)
    : stated_(rig),
      rig_(rig),
      shots_folder_((fs::path(out_folder) / "shots").string()),
      paint_(std::move(paint)),
      files_(awaited_files(rig)),
      cache_((fs::path(out_folder) / "cache").string()) {
  calib::take_lens_of_points(rig_.pose, rig_.scene);
  objects_ = open_objects(rig_);
  if (rig_.pose.board_shot.empty()) instrument();
}

std::string WatchedShots::path_of(const std::string& rig_name) const {
  return (fs::path(shots_folder_) / rig_name).string();
}

std::size_t WatchedShots::still_awaited() const {
  return static_cast<std::size_t>(std::count_if(
      files_.begin(), files_.end(), [](const AwaitedFile& f) { return f.taken_from.empty(); }));
}

std::string WatchedShots::next() const {
  const auto at = std::find_if(files_.begin(), files_.end(),
                               [](const AwaitedFile& f) { return f.taken_from.empty(); });
  if (at == files_.end()) return "";
  if (at->shot_idx == AwaitedFile::kBoard) return at->rig_name + ": the board, as pose.shot";
  const SceneShot& shot = rig_.scene.shots[at->shot_idx];
  std::string out = fmt::format("{}: {} of {}, lit by {}", at->rig_name, shot.object, shot.material,
                                fmt::join(shot.lights, " and "));
  if (!shot.more_files.empty()) {
    out += fmt::format(", exposure {} of {}", at->exposure_idx + 1, shot.more_files.size() + 1);
  }
  return out;
}

std::size_t WatchedShots::slot_for(const std::string& name) const {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    if (files_[i].rig_name == name) return i;
  }
  for (std::size_t i = 0; i < files_.size(); ++i) {
    if (files_[i].taken_from.empty()) return i;
  }
  throw InputError(name, "all shots of the rig are there");
}

bool WatchedShots::is_complete(std::size_t shot_idx) const {
  return std::all_of(files_.begin(), files_.end(), [&](const AwaitedFile& f) {
    return f.shot_idx != shot_idx || !f.taken_from.empty();
  });
}

Instrument& WatchedShots::instrument() {
  if (!instrument_) {
    MeasureOptions options;
    options.estimate.model = "dipole";
    instrument_ = std::make_unique<Instrument>(rig_, objects_, options);
  }
  return *instrument_;
}

std::vector<std::string> WatchedShots::taken_from(std::size_t shot_idx) const {
  std::vector<std::string> out;
  for (const AwaitedFile& f : files_) {
    if (f.shot_idx == shot_idx) out.push_back(f.taken_from);
  }
  return out;
}

capture::ShotSource WatchedShots::source_of(const std::vector<std::size_t>& shot_idxs) {
  capture::ShotSource source = capture::shots_from(
      rig_.scene, shot_idxs, capture::FrameSource([this](std::size_t i, std::size_t k) {
        return capture::open_shot(rig_.scene, rig_.decoding, taken_from(i).at(k));
      }));
  for (std::size_t i = 0; i < shot_idxs.size(); ++i) source.names[i] = taken_from(shot_idxs[i]);
  source.cache = &cache_;
  source.digests = &digests_;
  return source;
}

void WatchedShots::forget_place(std::size_t shot_idx) {
  const SceneShot& shot = rig_.scene.shots[shot_idx];
  const SceneObject& stated = stated_.scene.object(shot.object);
  if (!stated.to_be_found || rig_.scene.object(shot.object).to_be_found) return;
  for (const AwaitedFile& f : files_) {
    if (f.shot_idx != AwaitedFile::kBoard && !f.taken_from.empty() &&
        rig_.scene.shots[f.shot_idx].object == shot.object) {
      return;
    }
  }
  put(stated);
}

// Where the first shot of a piece shows it, which later shots are compared with.
void WatchedShots::place_piece(const SceneShot& shot) {
  Rig one = rig_;
  one.scene.shots = {shot};
  place_pieces(one, shots_folder_);
  SceneObject found = one.scene.object(shot.object);
  found.to_be_found.reset();
  put(found);
}

void WatchedShots::put(const SceneObject& object) {
  std::ranges::replace(rig_.scene.objects, object.name, object, &SceneObject::name);
  instrument_.reset();
  objects_ = open_objects(rig_);
}

void WatchedShots::take_board(TakenShot& taken) {
  rig_.pose = stated_.pose;
  rig_.scene.camera = stated_.scene.camera;
  calib::take_points_and_lens(rig_.scene, rig_.decoding, shots_folder_, rig_.pose);
  instrument_.reset();
  instrument();
  taken.verdict.remarks.emplace_back("the board was found");
}

void WatchedShots::look_at(std::size_t slot, TakenShot& taken) {
  const std::size_t idx = files_[slot].shot_idx;
  const SceneShot& shot = rig_.scene.shots[idx];
  // Every look is at frames that are decoded once.
  capture::ShotSource source = source_of({idx});
  const std::vector<capture::RawFrame> frames =
      capture::frames_of(shot, idx, std::get<capture::FrameSource>(source.open));
  source.open =
      capture::FrameSource([&frames](std::size_t, std::size_t k) { return frames.at(k); });
  const capture::RawFrame& frame = frames.front();
  const double range_counts =
      frame.white_counts - *std::max_element(frame.black_counts.begin(), frame.black_counts.end());
  if (rig_.scene.object(shot.object).to_be_found) {
    // Where it is stated to stand is near enough to see whether it can be found.
    const FirstLook there = instrument().look(source);
    taken.verdict = judge_exposure(there.shots.front(), range_counts);
    if (!taken.verdict.is_accepted()) return;
    place_piece(shot);
  }
  const FirstLook look = instrument().look(source);
  LookedAtShot at{look, range_counts, rig_.scene.camera.intrinsics.fx_px, "", 0.0};
  for (const AwaitedFile& f : files_) {
    if (f.shot_idx == AwaitedFile::kBoard || !off_px_.contains(f.rig_name) ||
        rig_.scene.shots[f.shot_idx].object != shot.object || f.shot_idx == idx) {
      continue;
    }
    at.earlier = f.rig_name;
    at.earlier_off_px = off_px_.at(f.rig_name);
  }
  taken.verdict = judge(at);
  const ObservedShot& opened = look.shots.front();
  const Rigid3d world_from_camera = inverse(opened.pose.camera_from_world);
  seen_from_ = {world_from_camera.translation_mm, world_from_camera * Eigen::Vector3d::UnitZ(),
                world_from_camera.rotation * -Eigen::Vector3d::UnitY()};
  if (paint_) {
    taken.png = paint_(frame, {rig_.scene.camera.intrinsics, opened.pose.camera_from_world},
                       *opened.seen->object->rays, opened.seen->map);
  }
  if (taken.verdict.is_accepted()) off_px_[shot.file] = outline_off_px(look);
}

std::optional<std::size_t> WatchedShots::other_slot(std::size_t slot,
                                                    const std::vector<std::string>& lights) {
  const SceneShot& stated = rig_.scene.shots[files_[slot].shot_idx];
  const std::string& piece = rig_.scene.object(stated.object).piece_name();
  for (std::size_t i = 0; i < files_.size(); ++i) {
    if (i == slot || files_[i].shot_idx == AwaitedFile::kBoard || !files_[i].taken_from.empty()) {
      continue;
    }
    const SceneShot& shot = rig_.scene.shots[files_[i].shot_idx];
    std::vector<std::string> sorted = shot.lights;
    std::sort(sorted.begin(), sorted.end());
    if (rig_.scene.object(shot.object).piece_name() == piece && shot.material == stated.material &&
        shot.more_files.empty() && sorted == lights) {
      return i;
    }
  }
  return std::nullopt;
}

TakenShot WatchedShots::take_as(std::size_t slot, const std::string& path) {
  AwaitedFile& file = files_[slot];
  TakenShot taken{path, file.rig_name, {}, {}, false};
  link_or_copy(path, path_of(file.rig_name));
  file.taken_from = path;
  try {
    if (file.shot_idx == AwaitedFile::kBoard) {
      take_board(taken);
      taken.completes_shot = true;
    } else if (is_complete(file.shot_idx)) {
      look_at(slot, taken);
      taken.completes_shot = true;
    } else {
      capture::open_shot(rig_.scene, rig_.decoding, path);
    }
  } catch (const InputError&) {
    release(path);
    throw;
  }
  if (!taken.verdict.is_accepted()) {
    // Of a bracket every exposure, as they show one scene.
    for (AwaitedFile& f : files_) {
      if (f.shot_idx == file.shot_idx && !f.taken_from.empty()) release(std::string(f.taken_from));
    }
  }
  return taken;
}

std::optional<TakenShot> WatchedShots::take(const std::string& path) {
  const std::string name = fs::path(path).filename().string();
  if (name != rig_.pose.board_shot && calibration_files(rig_).contains(name)) return std::nullopt;
  // A name that was used before, or a file under the rig's name after another was taken for it.
  release(path);
  const std::size_t slot = slot_for(name);
  if (!files_[slot].taken_from.empty()) release(std::string(files_[slot].taken_from));
  TakenShot taken = take_as(slot, path);
  if (taken.verdict.seen_lights.empty() || files_[slot].rig_name == name) return taken;
  const std::optional<std::size_t> other = other_slot(slot, taken.verdict.seen_lights);
  return other ? take_as(*other, path) : taken;
}

void WatchedShots::release(const std::string& path) {
  for (AwaitedFile& f : files_) {
    if (f.taken_from != path) continue;
    f.taken_from.clear();
    std::error_code ignored;
    fs::remove(path_of(f.rig_name), ignored);
    digests_.forget(path);
    off_px_.erase(f.rig_name);
    if (f.shot_idx != AwaitedFile::kBoard) forget_place(f.shot_idx);
    return;
  }
}

std::string WatchedShots::keep(const std::string& path) {
  for (AwaitedFile& f : files_) {
    if (f.taken_from != path) continue;
    f.taken_from = path_of(f.rig_name);
    digests_.forget(path);  // the name may come again with other contents
    return f.rig_name;
  }
  return "";
}

void WatchedShots::rename(const std::string& from, const std::string& to) {
  for (AwaitedFile& f : files_) {
    if (f.taken_from == from) f.taken_from = to;
  }
}

std::optional<std::string> WatchedShots::material_of(const std::string& rig_name) const {
  for (const AwaitedFile& f : files_) {
    if (f.rig_name == rig_name && f.shot_idx != AwaitedFile::kBoard) {
      return rig_.scene.shots[f.shot_idx].material;
    }
  }
  return std::nullopt;
}

RunningAnswer WatchedShots::answer(const std::string& rig_name) {
  const std::string material = material_of(rig_name).value();
  std::vector<std::size_t> accepted;
  std::optional<std::size_t> next;
  for (std::size_t i = 0; i < rig_.scene.shots.size(); ++i) {
    if (rig_.scene.shots[i].material != material) continue;
    if (is_complete(i)) {
      accepted.push_back(i);
    } else if (!next) {
      next = i;
    }
  }
  RunningAnswer out;
  out.channels = instrument().measure(source_of(accepted)).results;
  if (!next) return out;
  out.next = rig_.scene.shots[*next].file;
  accepted.push_back(*next);
  std::sort(accepted.begin(), accepted.end());
  Rig seen = rig_;
  seen.truth.pose = seen_from_;
  out.with_next = forecast(std::move(seen), objects_, material, out.channels, accepted);
  return out;
}

}  // namespace scattermeter::apps
