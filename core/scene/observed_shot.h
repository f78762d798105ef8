// A shot reduced to what its patches show.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/camera/camera_pose.h"
#include "core/camera/cfa_samples.h"
#include "core/scene/scene.h"
#include "core/scene/seen_object.h"
#include "core/view/observation.h"

namespace scattermeter {

// How the light of one exposure of a bracket departs from that of the others.
struct ExposureDeparture {
  // ln of this exposure's light over that of the others, by their times; NaN where no sample is in
  // this and another one.
  double log_ratio = 0;
  double noise_std = 0;    // of that, by the samples' variances
  double mean_counts = 0;  // of this exposure's samples in the sums: a count of black is 1 / this
};

// One exposure of a shot.
struct ShotExposure {
  std::string file;             // as in the scene
  double stated_s = 0;          // by the file
  double true_s = 0;            // by the radiance calibration; without it the stated time is exact
  double relative_std = 0;      // of true_s
  double black_std_counts = 0;  // of this file's black, common to its samples
  ExposureDeparture departure = {};  // in a bracket: from the others
};

// What a measurement takes from the files of a shot, and what a cache keeps of it.
struct DecodedShot {
  Observation observation;
  double exposure_s = 0;  // in whose counts the shot is stated; of a bracket the first one's
  double iso = 0;
  double f_number = 0;
  std::vector<ShotExposure> exposures;           // as observation's; empty for samples from memory
  std::array<double, kRgb> frame_mean_counts{};  // of which glare is a share
};

struct ObservedShot : DecodedShot {
  const SceneShot* stated = nullptr;
  std::shared_ptr<const SeenObject> seen;
  PoseResult pose;
  bool has_own_pose = false;        // estimated from this shot alone; else that of all shots
  std::size_t samples_outside = 0;  // of the frames, in no object's rectangle: not converted
};

}  // namespace scattermeter
