// The shots of a rig while they are taken, one after the other.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/checking/checked_rig.h"
#include "apps/instrument/instrument.h"
#include "apps/rig/rig.h"
#include "apps/watching/awaited_file.h"
#include "apps/watching/running_answer.h"
#include "apps/watching/shot_verdict.h"
#include "capture/files/digest.h"
#include "capture/shots/shot_cache.h"
#include "capture/shots/shot_source.h"
#include "core/scene/object_scene.h"

namespace scattermeter::apps {

// What became of an arrived file.
struct TakenShot {
  std::string file;      // that arrived
  std::string rig_name;  // for which it was taken
  ShotVerdict verdict;
  std::string png;              // a picture of it, by ShotPainter; empty: none
  bool completes_shot = false;  // the last exposure of its bracket, so that it was looked at
};

class WatchedShots {
 public:
  // out_folder: accepted shots are linked or copied to its folder `shots` under the names that the
  // rig gives them, and their decoded samples are kept in `cache`, as by `measure`. The rig must
  // outlive it. paint may be empty. Throws InputError for a rig that cannot be opened.
  WatchedShots(const Rig& rig, const std::string& out_folder, ShotPainter paint);

  const std::vector<AwaitedFile>& files() const { return files_; }
  std::string shots_folder() const { return shots_folder_; }
  std::size_t still_awaited() const;
  // "led1.dng: cube of PP, lit by led1"; "" when nothing is awaited.
  std::string next() const;

  // Takes the file for the shot of its name or, if the rig does not name it, for the next one that
  // is awaited; where the image shows the lights of another awaited shot of the same piece and
  // material, for that one. A shot that was rejected is awaited again. Returns nothing for a file
  // that the rig lists for its calibrations. Throws InputError for one that cannot be read as a
  // shot, and where nothing is awaited.
  std::optional<TakenShot> take(const std::string& path);
  // The file is gone: what it was accepted for keeps its copy in the folder of accepted shots.
  // Returns the rig's name of that; "" if there is none.
  std::string keep(const std::string& path);
  void rename(const std::string& from, const std::string& to);

  // Of the shot of that name; nothing for the board's.
  std::optional<std::string> material_of(const std::string& rig_name) const;
  // Of the material of the shot, by all its accepted shots. Throws InputError as measure() does.
  RunningAnswer answer(const std::string& rig_name);

 private:
  std::size_t slot_for(const std::string& name) const;
  // What the file was accepted for is awaited again.
  void release(const std::string& path);
  TakenShot take_as(std::size_t slot, const std::string& path);
  void take_board(TakenShot& taken);
  void look_at(std::size_t slot, TakenShot& taken);
  void place_piece(const SceneShot& shot);
  // Puts the piece of the shot back to where it is stated to stand, to be found again, unless
  // another accepted shot shows it.
  void forget_place(std::size_t shot_idx);
  // In place of the object of its name.
  void put(const SceneObject& object);
  Instrument& instrument();
  std::string path_of(const std::string& rig_name) const;
  bool is_complete(std::size_t shot_idx) const;
  std::vector<std::string> taken_from(std::size_t shot_idx) const;  // its exposures in order
  capture::ShotSource source_of(const std::vector<std::size_t>& shot_idxs);
  std::optional<std::size_t> other_slot(std::size_t slot, const std::vector<std::string>& lights);

  const Rig& stated_;
  Rig rig_;  // with pieces where they were found
  std::string shots_folder_;
  ShotPainter paint_;
  std::vector<AwaitedFile> files_;
  capture::FileDigests digests_;
  capture::ShotCache cache_;
  std::map<std::string, double> off_px_;      // of accepted shots, by rig name
  std::optional<CameraPlacement> seen_from_;  // the last shot
  ObjectScenes objects_;
  std::unique_ptr<Instrument> instrument_;
};

}  // namespace scattermeter::apps
