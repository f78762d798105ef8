// The shots that a rig would take of its truth: rendered once, exposed as often as wanted.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/rig/open_objects.h"
#include "apps/rig/rig.h"
#include "apps/simulation/shot_renderer.h"
#include "capture/raw/raw_frame.h"
#include "capture/sensor/virtual_sensor.h"
#include "capture/shots/shot_source.h"
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

// Rig and objects must outlive it. Const members may be called from several threads at once.
class VirtualShots {
 public:
  // Renders every shot of the rig with the rig's truth materials. The camera is at truth.pose, or
  // at the pose from the pose points. If the rig has no exposure time, one is chosen for all shots
  // so that the brightest sample reaches three quarters of the range; without a responsivity, the
  // time is 0.1 s and the responsivity is chosen instead. Throws InputError for what the rig lacks
  // (such as the times of a bracket) and for an object out of view.
  VirtualShots(const Rig& rig, const ObjectScenes& objects, const VirtualShotOptions& options);

  std::size_t size() const { return pictures_.size(); }
  // See ShotRenderer.
  double monte_carlo_std() const { return monte_carlo_std_; }
  // `exposure`: index in SceneShot::files(), here and below.
  double exposure_s(std::size_t shot, std::size_t exposure = 0) const;
  // Signal of the object's brightest sample without noise, as a share of the sensor's range (above
  // 1: it clips).
  double brightest_share(std::size_t shot, std::size_t exposure = 0) const;
  // Counts per (W/(mm^2 sr)) and second: the rig's, or as chosen.
  const std::array<double, 3>& responsivity() const { return responsivity_; }

  // Without noise: the rectangle around the object (with a board in the shot, the whole frame), and
  // the whole frame with zeros outside of it.
  const LinearPicture& picture(std::size_t shot) const { return pictures_.at(shot); }
  std::vector<float> whole_signal_counts(std::size_t shot, std::size_t exposure = 0) const;

  // One exposure. Each has its own random stream of the seed: the same seed gives the same codes,
  // in memory and in a file.
  std::vector<std::uint16_t> codes(std::size_t shot, std::uint64_t seed,
                                   std::size_t exposure = 0) const;
  // As the raw reader delivers the written file (exceptions: capture/raw/decoded_frame.h).
  capture::RawFrame frame(std::size_t shot, std::uint64_t seed, std::size_t exposure = 0) const;
  // The same without noise, whatever the options say.
  capture::RawFrame expected_frame(std::size_t shot, std::size_t exposure = 0) const;
  // Writes the 12-bit DNG, complete or not at all. Throws InputError naming the file.
  void write(std::size_t shot, std::uint64_t seed, const std::string& path,
             std::size_t exposure = 0) const;

  // Part of the frame as seen by a sensor without noise, rounding and truth.sensor.
  CfaSamples ideal_samples(std::size_t shot, int x0, int y0, int width, int height) const;

  // Sources of all shots, which must not outlive *this: with the noise of this seed, as
  // expected_frame(), as ideal_samples().
  capture::ShotSource source(std::uint64_t seed) const;
  capture::ShotSource expected_source() const;
  capture::ShotSource ideal_source() const;

 private:
  std::uint64_t stream(std::size_t shot, std::uint64_t seed, std::size_t exposure) const;
  void choose_exposure(const Eigen::Array3d& brightest);

  const Rig& rig_;
  VirtualShotOptions options_;
  capture::VirtualSensor sensor_;
  std::vector<LinearPicture> pictures_;
  std::vector<double> exposure_s_;
  std::vector<double> brightest_share_;  // of each shot's first exposure
  std::array<double, 3> responsivity_{};
  double default_exposure_s_ = 0;
  double monte_carlo_std_ = 0;
};

}  // namespace scattermeter::apps
