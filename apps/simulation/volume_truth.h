// Shots of a rig's truth by volumetric Monte Carlo, with the noise that remains in them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "apps/rig/open_objects.h"
#include "apps/rig/rig.h"
#include "apps/simulation/virtual_shots.h"
#include "capture/shots/shot_source.h"

namespace scattermeter::apps {

struct VolumeTruthOptions {
  std::int64_t paths = 1'000'000;  // for each light and channel, of all batches together
  // Independent renderings, >= 2; the noise of their mean, estimated from n of them, has a relative
  // standard deviation of 1 / sqrt(2 (n - 1)).
  int batches = 8;
  std::uint64_t seed = 1;
  // Seed of the sensor's noise; absent: no noise. Nothing is rounded or clipped.
  std::optional<std::uint64_t> noise_seed = std::nullopt;
};

// Rig and objects must outlive it, and it must outlive the sources that it returns.
class VolumeTruth {
 public:
  // Renders the rig's shots of its truth materials; channels in which no light of a shot has power
  // take no time. One exposure is chosen for all shots. Throws InputError for what cannot be
  // rendered, std::invalid_argument for fewer than two batches.
  VolumeTruth(const Rig& rig, const ObjectScenes& objects, const VolumeTruthOptions& options);

  VolumeTruth(const VolumeTruth&) = delete;
  VolumeTruth& operator=(const VolumeTruth&) = delete;

  // The mean of the batches.
  capture::SampleSource shots() const;

  int batches() const { return static_cast<int>(batches_.size()); }
  // The dipole's image of the truth plus noise of the size of the mean's: the difference of a batch
  // from the mean, divided by the square root of the number of batches. The standard deviation over
  // the batches of the estimates from these images is the one that the noise of shots() causes in
  // an estimate (by the derivatives of the dipole at the truth, which are close to those of any
  // correct model).
  capture::SampleSource disturbed(int batch) const;

  // Relative standard deviation of a patch's light in shots(): the renderer's median over the
  // patches, largest over shots and channels, mean over batches.
  double patch_std() const;

 private:
  Rig exposed_;  // the rig with the exposure
  std::vector<VirtualShots> batches_;
  std::vector<VirtualShots> dipole_;  // a single one
  VolumeTruthOptions options_;
};

}  // namespace scattermeter::apps
