// What the first frames of the shots say about their colour filters, hot pixels and missing rows,
// while they are opened.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <vector>

#include "apps/looks/finding.h"
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
  // that of the file. (Green sites of real sensors differ by at most 2 %.) And shots of which more
  // than 1 % of the samples stand out from their neighbours: so many are not taken for noise and
  // not left out as single outliers, but make rows too bright. And shots of which more
  // than 0.5 % of the rows contain nothing but zeros, where black is not zero.
  std::vector<Finding> findings() const;

 private:
  const Scene& scene_;
  mutable std::mutex mutex_;
  struct Seen {
    double greens_differ, hot_share, empty_share;
  };
  std::map<std::size_t, Seen> seen_;  // by index of the shot
};

}  // namespace scattermeter::apps
