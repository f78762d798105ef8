// Shots of the truth by volume Monte Carlo, and what is left of its noise.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "apps/instrument/open_objects.h"
#include "apps/rig/rig.h"
#include "apps/simulation/virtual_shots.h"
#include "capture/shots/shot_source.h"

namespace scattermeter::apps {

struct VolumeTruthOptions {
  std::int64_t paths = 1'000'000;  // for each light and channel, of all batches together
  // Independent renderings, >= 2; the noise of their mean, judged from n of them, is known to
  // 1 / sqrt(2 (n - 1)) of itself.
  int batches = 8;
  std::uint64_t seed = 1;
  // Of the sensor's noise; absent: the mean signal itself. Nothing is rounded or clipped.
  std::optional<std::uint64_t> noise_seed = std::nullopt;
};

// Rig and scenes must outlive it, and it must outlive the sources it gives.
class VolumeTruth {
 public:
  // Renders the rig's shots on its truth materials; channels in which no light of a shot has power
  // cost nothing. The exposure is chosen, one for all shots. Throws InputError and
  // std::invalid_argument for what cannot be rendered, or for fewer than two batches.
  VolumeTruth(const Rig& rig, const ObjectScenes& scenes, const VolumeTruthOptions& options);

  VolumeTruth(const VolumeTruth&) = delete;
  VolumeTruth& operator=(const VolumeTruth&) = delete;

  // The mean of the batches.
  capture::SampleSource shots() const;

  int batches() const { return static_cast<int>(batches_.size()); }
  // An image that a dipole makes of the truth, and on it the noise of the mean: the difference of a
  // batch and the mean, divided by the square root of their number. What answers to these vary by
  // over the batches is the standard deviation that the noise of shots() has left in an answer (by
  // the derivatives of the dipole at the truth, which are near those of any model that is right).
  capture::SampleSource disturbed(int batch) const;

  // Relative deviation of a patch's light in shots(): the renderer's median over the patches,
  // largest over shots and channels, mean over batches.
  double patch_std() const;

 private:
  Rig exposed_;  // the rig with the exposure
  std::vector<VirtualShots> batches_;
  std::vector<VirtualShots> dipole_;  // one
  VolumeTruthOptions options_;
};

}  // namespace scattermeter::apps
