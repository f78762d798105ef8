// A shot reduced to observations of its patches.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/camera/camera_pose.h"
#include "core/camera/cfa_samples.h"
#include "core/scene/scene.h"
#include "core/scene/seen_object.h"
#include "core/view/observation.h"

namespace scattermeter {

// Departure of the light of one exposure of a bracket from that of the others.
struct ExposureDeparture {
  // ln of the ratio of this exposure's light to that of the others, after scaling by their times;
  // NaN if it shares no sample with another one.
  double log_ratio = 0;
  double noise_std = 0;    // of log_ratio, from the samples' variances
  double mean_counts = 0;  // of this exposure's samples; an error of one count in black changes
                           // log_ratio by 1 / this
};

// One exposure of a shot.
struct ShotExposure {
  std::string file;                  // as in the scene
  double stated_s = 0;               // from the file
  double true_s = 0;                 // calibrated; without a calibration stated_s
  double relative_std = 0;           // of true_s
  double black_std_counts = 0;       // of this file's black level, common to its samples
  ExposureDeparture departure = {};  // in a bracket
  // Counts common to the samples of a channel besides their light, already subtracted, and the
  // standard deviation of what remains: black level and glare (capture/shots/pedestal.h). 0 with a
  // radiance calibration, which states its own.
  std::array<double, kRgb> pedestal_counts{};
  std::array<double, kRgb> pedestal_std_counts{};
  // How much brighter the background is beside the object than where it is darkest: a halo of the
  // lens, or a stand that is lit. 0 where that may be chance.
  std::array<double, kRgb> beside_counts{};
};

// Blur of the object's outline.
struct EdgeBlur {
  bool is_measured = false;  // false: too little of the outline is seen
  // Covariance of the point spread beyond what a sharp edge may seem to have, along the picture's
  // axes (right, down), on the object.
  Eigen::Matrix2d mm2 = Eigen::Matrix2d::Zero();
  double largest_std_mm() const {
    const double mean = 0.5 * mm2.trace();
    return std::sqrt(std::max(0.0, mean + std::hypot(0.5 * (mm2(0, 0) - mm2(1, 1)), mm2(0, 1))));
  }
};

// The part of a shot's files that a measurement uses and a cache stores.
struct DecodedShot {
  Observation observation;
  double exposure_s = 0;  // the one in whose counts the shot is expressed; for a bracket, the first
  double iso = 0;
  double f_number = 0;
  std::vector<ShotExposure> exposures;           // as observation's; empty for samples from memory
  std::array<double, kRgb> frame_mean_counts{};  // glare is a share of it
  std::optional<EdgeBlur> edge_blur;             // absent: not looked for
};

struct ObservedShot : DecodedShot {
  const SceneShot* stated = nullptr;
  std::shared_ptr<const SeenObject> seen;
  PoseResult pose;
  bool has_own_pose = false;        // estimated from this shot alone; otherwise common to all shots
  std::size_t samples_outside = 0;  // in no object's rectangle: not converted
  // What the object's outline leaves open of its size, besides scale_relative_std.
  double size_open_relative = 0;

  // The name of its view: shots of one object with a common pose have the same.
  const std::string& view_name() const { return has_own_pose ? stated->file : stated->object; }
  // The name of its pose among the nuisances, without the number of the combination.
  std::string pose_name() const { return has_own_pose ? "pose " + stated->file : "pose"; }
  // Of all lengths of the object.
  double size_relative_std() const {
    return std::hypot(seen->object->stated->scale_relative_std, size_open_relative);
  }
  // Size of a pixel on the object.
  double px_mm(double fx_px) const {
    return (pose.camera_from_world * seen->object->box.center_mm()).z() / fx_px;
  }
};

}  // namespace scattermeter
