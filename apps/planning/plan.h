// Predicted uncertainties of what a rig's shots will measure, before they are taken.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/instrument/measure.h"
#include "apps/planning/expected_materials.h"
#include "apps/planning/exposure_advice.h"
#include "apps/planning/suggested_shots.h"
#include "apps/rig/open_objects.h"
#include "apps/rig/rig.h"
#include "apps/simulation/virtual_shots.h"
#include "capture/sensor/noise_model.h"
#include "core/base/progress.h"
#include "core/camera/cfa_samples.h"
#include "core/camera/sensor_noise.h"
#include "core/fit/estimate.h"
#include "core/material/medium.h"

namespace scattermeter::apps {

struct PlanOptions {
  // Expected coefficients of all materials and channels; absent: the rig's truth.materials.
  std::optional<ExpectedRange> sigma_s_prime_per_mm;
  std::optional<ExpectedRange> sigma_a_per_mm;
  std::optional<double> patch_size_mm;     // as MeasureOptions
  bool suggested_shots = true;             // maps of LED positions, and gains
  const VirtualShots* rendered = nullptr;  // of the rig's truth, to save rendering them again
  Progress* progress = nullptr;
};

// The result that `measure` would report for a medium.
struct Forecast {
  Medium medium;  // eta is the object's
  Estimate estimate;
};

// A material in a channel.
struct PlannedChannel {
  Forecast expected;     // for the rig's truth or the middle of the ranges
  ChannelResult result;  // for the expected medium: `measure` on shots without noise
  // At the corners of the ranges; empty if only one medium is expected.
  std::vector<Forecast> corners;
};

// Standard deviations if a single cause of uncertainty were known exactly, all else as planned.
struct KnownCause {
  std::string cause;
  double sigma_s_prime_std_per_mm = 0;
  double sigma_a_std_per_mm = 0;
};
// One for each line of the budget except noise and numerics, ordered by the standard deviation of
// sigma_a that remains.
std::vector<KnownCause> known_causes(const Estimate& estimate);

struct Plan {
  std::vector<PlannedChannel> channels;         // as Measurement::results
  std::vector<ExposureAdvice> exposures;        // for every shot and channel, in the rig's order
  std::vector<SuggestedShots> suggested_shots;  // for every material, in its least known channel
  bool from_truth = true;                       // otherwise from the ranges of the options
  bool brightness_known = true;                 // the rig has a responsivity
  bool neutral_camera = false;                  // see planned_rig()
  bool calibrated_noise = false;                // from camera.radiance, otherwise camera.sensor
  std::array<SensorNoise, kRgb> noise;          // R, G, B
  std::map<std::string, double> patch_size_mm;
  std::vector<InputFile> inputs;  // rig, meshes, probes
  std::vector<std::pair<std::string, double>> timing_s;
  std::shared_ptr<const RigPlaces> places;  // where everything will stand
  bool any_refused() const;                 // also at a corner of the ranges
};

// The rig whose shots are simulated. If the rig names a radiance calibration but has no
// truth.sensor for it to correct, the simulated camera needs no correction: the calibration is
// replaced by one that corrects nothing and keeps every standard deviation.
Rig planned_rig(const Rig& rig);

// Renders the rig's shots of the expected materials by the dipole, exposes them without noise, and
// measures them as `measure --model dipole` does, with the same selection and weights of rows; the
// covariance is the estimator's own, with noise by the camera's noise model. Throws InputError for
// what the rig lacks and for what measuring would refuse; std::invalid_argument for invalid ranges.
Plan plan(const Rig& rig, const PlanOptions& options = {}, Progress* progress = nullptr);
// The same with objects that are already open; leaves Plan::inputs empty.
Plan plan(const Rig& rig, const ObjectScenes& objects, const PlanOptions& options);

// Relative standard deviations of one coefficient over the expected medium and the corners; NaN if
// there are none.
struct RelativeRange {
  double low = 0;
  double high = 0;
};
RelativeRange relative_range(const PlannedChannel& channel, Quantity Estimate::*coefficient);

// "2.5 %", or "2 … 3.5 %" for a range; a dash if the value is not finite.
std::string percent_text(double relative);
std::string percent_text(const RelativeRange& range);

}  // namespace scattermeter::apps
