// What the first frames of the shots say about colour filters and focus, while they are opened.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "apps/instrument/finding.h"
#include "apps/rig/rig.h"
#include "capture/raw/raw_frame.h"
#include "core/camera/camera_pose.h"
#include "core/estimation/channel_result.h"
#include "core/scene/object_scene.h"

namespace scattermeter::apps {

class FrameWatch {
 public:
  // Rig, objects and pose must outlive it.
  FrameWatch(const Rig& rig, const ObjectScenes& objects, const PoseResult& pose);
  FrameWatch(const FrameWatch&) = delete;
  FrameWatch& operator=(const FrameWatch&) = delete;

  // Looks at the first frame of a shot; from any thread.
  void look(std::size_t shot_idx, const capture::RawFrame& frame);

  // Shots whose two green sites differ by more than 5 %: their pattern of colour filters is not
  // that of the file. (Green sites of real sensors differ by at most 2 %.)
  std::vector<Finding> findings() const;
  // Blur of the outline in mm on the object, by object; only objects with sharp edges, of which one
  // shot is judged.
  std::map<std::string, double> blur_mm() const;

 private:
  const Rig& rig_;
  const ObjectScenes& objects_;
  const PoseResult& pose_;
  std::map<std::string, std::size_t> judged_;  // by object: its first shot in the scene
  mutable std::mutex mutex_;
  std::map<std::size_t, double> green_ratio_;  // by index of the shot
  std::map<std::string, double> blur_mm_;
};

// Adds the effect of blur to the estimates, up to 2 (blur / mean free path)^2 of sigma_s', and
// refuses those that it may change by more than 3 %. Returns whether there were any.
bool widen_by_blur(const Scene& scene, const std::map<std::string, double>& blur_mm,
                   std::vector<ChannelResult>& results);

}  // namespace scattermeter::apps
