// The source of the camera's pose in each frame.
#pragma once

#include <functional>
#include <string>

#include "calib/pose/pose.h"
#include "capture/raw/raw_frame.h"

namespace scattermeter::calib {

struct FramePose {
  // Pose of the camera in a frame; `file` is for messages. Throws InputError if there is none.
  std::function<PoseResult(const capture::RawFrame& frame, const std::string& file)> estimate;
  bool is_shared = false;  // the camera does not move: all frames have the same pose
};

}  // namespace scattermeter::calib
