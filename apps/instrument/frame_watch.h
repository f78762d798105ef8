// What the first frames of the shots say about their colour filters, while they are opened.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <vector>

#include "apps/instrument/finding.h"
#include "capture/raw/raw_frame.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

class FrameWatch {
 public:
  // The scene must outlive it.
  explicit FrameWatch(const Scene& scene) : scene_(scene) {}
  FrameWatch(const FrameWatch&) = delete;
  FrameWatch& operator=(const FrameWatch&) = delete;

  // Looks at the first frame of a shot; from any thread.
  void look(std::size_t shot_idx, const capture::RawFrame& frame);

  // Shots whose two green sites differ by more than 5 %: their pattern of colour filters is not
  // that of the file. (Green sites of real sensors differ by at most 2 %.)
  std::vector<Finding> findings() const;

 private:
  const Scene& scene_;
  mutable std::mutex mutex_;
  std::map<std::size_t, double> green_ratio_;  // by index of the shot
};

}  // namespace scattermeter::apps
