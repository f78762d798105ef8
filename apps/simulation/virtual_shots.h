// The shots that a rig would take of its truth: rendered once, exposed as often as wanted.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/instrument/open_objects.h"
#include "apps/rig/rig.h"
#include "apps/simulation/shot_renderer.h"
#include "capture/raw/raw_frame.h"
#include "capture/sensor/virtual_sensor.h"
#include "core/base/progress.h"
#include "core/camera/cfa_samples.h"

namespace scattermeter::apps {

struct VirtualShotOptions {
  bool noise = true;  // off: rounding only
  Progress* progress = nullptr;
  RenderTransport transport = {};
};

// Expected signal above black, counts, in the part of the frame where there is any.
struct LinearPicture {
  int x0 = 0, y0 = 0, width = 0, height = 0;  // px
  std::vector<float> counts;                  // row by row
};

// Rig and scenes must outlive it. Everything const may be called from several threads at once.
class VirtualShots {
 public:
  // Renders every shot of the rig on the rig's truth materials. The camera stands
  // at truth.pose, or where the pose points put it. Without an exposure time in the rig one is
  // chosen for all shots so that the brightest sample reaches three quarters of the range; without
  // a responsivity 0.1 s is taken and the responsivity chosen instead. Throws InputError for what
  // the rig lacks (a bracket without its times is one) or an object out of view.
  VirtualShots(const Rig& rig, const ObjectScenes& scenes, const VirtualShotOptions& options);

  std::size_t size() const { return pictures_.size(); }
  // See ShotRenderer.
  double monte_carlo_std() const { return monte_carlo_std_; }
  // `exposure`: place in SceneShot::files(), here and below.
  double exposure_s(std::size_t shot, std::size_t exposure = 0) const;
  // Counts per (W/(mm^2 sr)) and second, the rig's or the one that was chosen.
  const std::array<double, 3>& responsivity() const { return responsivity_; }

  // Without noise: the rectangle around the object (with a board in the shot, the whole frame), and
  // the same spread over the frame, zero elsewhere.
  const LinearPicture& picture(std::size_t shot) const { return pictures_.at(shot); }
  std::vector<float> whole_signal_counts(std::size_t shot, std::size_t exposure = 0) const;

  // One exposure. Each draws from a stream of the seed of its own: the same seed gives the same
  // codes, in memory and in a file.
  std::vector<std::uint16_t> codes(std::size_t shot, std::uint64_t seed,
                                   std::size_t exposure = 0) const;
  // As the raw reader delivers the written file (exceptions: capture/raw/decoded_frame.h).
  capture::RawFrame frame(std::size_t shot, std::uint64_t seed, std::size_t exposure = 0) const;
  // The same without noise, whatever the options say.
  capture::RawFrame expected_frame(std::size_t shot, std::size_t exposure = 0) const;
  // Writes the 12-bit DNG; it appears complete or not at all. Throws InputError naming the file.
  void write(std::size_t shot, std::uint64_t seed, const std::string& path,
             std::size_t exposure = 0) const;

  // A rectangle of the frame as a sensor without noise, rounding and truth.sensor sees it.
  CfaSamples ideal_samples(std::size_t shot, int x0, int y0, int width, int height) const;

 private:
  std::uint64_t stream(std::size_t shot, std::uint64_t seed, std::size_t exposure) const;
  void choose_exposure(const Eigen::Array3d& brightest);

  const Rig& rig_;
  VirtualShotOptions options_;
  capture::VirtualSensor sensor_;
  std::vector<LinearPicture> pictures_;
  std::vector<double> exposure_s_;
  std::array<double, 3> responsivity_{};
  double default_exposure_s_ = 0;
  double monte_carlo_std_ = 0;
};

}  // namespace scattermeter::apps
