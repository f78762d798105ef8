// The objects' outlines in the shots, looked at while the shots are opened.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/looks/finding.h"
#include "apps/looks/moved_piece.h"
#include "apps/looks/other_outline.h"
#include "apps/rig/rig.h"
#include "calib/pose/outline_causes.h"
#include "capture/raw/raw_frame.h"
#include "capture/shots/shot_source.h"
#include "core/scene/object_scene.h"

namespace scattermeter::apps {

struct OutlineFindings {
  std::vector<Finding> findings;  // the most probable first
  std::vector<std::string> notes;
  std::set<std::string> unjudged;  // objects whose outlines have too few straight edges
  // By ObservedShot::view_name(), if the outlines show where the objects stand within the rig's
  // uncertainty: the shift of the pose relative to them. Empty otherwise.
  std::map<std::string, PoseShift> shifts;
  MovedPieces moved;  // the pieces whose positions the careful search tells better
  // By object, where its outline does not tell cut edges from another size:
  // ObservedShot::size_open_relative.
  std::map<std::string, double> sizes_open;
  // Absent without a shot whose outline was seen.
  std::optional<calib::OutlineDiagnosis> diagnosis;
  std::vector<std::size_t> looked_at;  // indices of the shots in the scene, as in the diagnosis
};

// For a camera that does not move, before a dark background.
class OutlineWatch {
 public:
  // Rig, objects and pose must outlive it.
  OutlineWatch(const Rig& rig, const ObjectScenes& objects, const PoseResult& pose);
  OutlineWatch(const OutlineWatch&) = delete;
  OutlineWatch& operator=(const OutlineWatch&) = delete;

  // Looks at the first frame of a shot; from any thread.
  void look(std::size_t shot_idx, const capture::RawFrame& frame);

  // What the looks so far say. Opens frames of `source` again only where something is wrong: to
  // look about the place that a first look found, and for the outline of other objects.
  OutlineFindings findings(const capture::ShotSource& source) const;

 private:
  struct Seen {
    const std::vector<calib::ContourPoint>* contour = nullptr;
    calib::OutlineLook look;
  };
  using Looks = std::map<std::size_t, Seen>;  // by index of the shot in the scene

  std::size_t body_of(std::size_t shot_idx) const;
  std::map<std::size_t, std::vector<std::size_t>> shots_of_bodies(const Looks& looks) const;
  calib::OutlineDiagnosis explain(const Looks& looks,
                                  const std::vector<Eigen::Vector3d>& assumed_mm,
                                  std::vector<std::size_t>& looked_at) const;
  void find_other_objects(const capture::FrameSource& frames, Looks& looks,
                          OutlineFindings& out) const;
  void find_unseen(Looks& looks, OutlineFindings& out) const;
  calib::OutlineDiagnosis look_again(const capture::FrameSource& frames, const Looks& looks,
                                     calib::OutlineDiagnosis first,
                                     std::vector<std::size_t>& looked_at) const;
  bool find_other_sizes(const capture::FrameSource& frames, const Looks& looks,
                        OutlineFindings& out) const;
  void look_closely(const capture::FrameSource& frames, const Looks& looks,
                    OutlineFindings& out) const;
  void find_scaled_pieces(const capture::FrameSource& frames, const Looks& looks,
                          OutlineFindings& out) const;
  void conclude(const Looks& looks, OutlineFindings& out) const;
  void say_exactly(const capture::FrameSource& frames, OutlineFindings& out) const;

  const Rig& rig_;
  const ObjectScenes& objects_;
  const PoseResult& pose_;
  Contours contours_;
  std::vector<std::string> names_;           // of the objects in the scene
  std::vector<Eigen::Vector3d> centers_mm_;  // likewise; 0 for objects without a shot
  Looks looks_;
  mutable std::mutex mutex_;
};

}  // namespace scattermeter::apps
