// What a rig's shots will be able to tell, before they are taken.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/instrument/measure.h"
#include "apps/instrument/open_objects.h"
#include "apps/planning/exposure_advice.h"
#include "apps/planning/other_shots.h"
#include "apps/rig/rig.h"
#include "apps/simulation/virtual_shots.h"
#include "capture/sensor/noise_model.h"
#include "core/base/progress.h"
#include "core/camera/cfa_samples.h"
#include "core/camera/sensor_noise.h"
#include "core/fit/estimate.h"
#include "core/material/medium.h"

namespace scattermeter::apps {

// Of a coefficient, 1/mm; 0 <= low <= high.
struct ExpectedRange {
  double low = 0;
  double high = 0;
};

struct PlanOptions {
  // Of every material and channel, in place of the rig's truth.materials.
  std::optional<ExpectedRange> sigma_s_prime_per_mm;
  std::optional<ExpectedRange> sigma_a_per_mm;
  std::optional<double> patch_size_mm;     // as MeasureOptions
  bool other_shots = true;                 // maps of LED positions and gains
  const VirtualShots* rendered = nullptr;  // of the rig's truth, to save rendering them again
  Progress* progress = nullptr;
};

// What `measure` would state of a medium.
struct Forecast {
  Medium medium;  // eta is the object's
  Estimate estimate;
};

// A material in a channel.
struct PlannedChannel {
  Forecast expected;     // at the rig's truth, or the middle of the range
  ChannelResult result;  // of the expected medium: `measure` on shots without noise
  // The corners of the range; empty where the material is one medium.
  std::vector<Forecast> corners;
};

// Expected standard deviation where a single cause were known exactly, all else as planned.
struct KnownCause {
  std::string cause;
  double sigma_s_prime_std_per_mm = 0;
  double sigma_a_std_per_mm = 0;
};
// Of every line of the budget but noise and errors of the method, the most helpful for sigma_a
// first.
std::vector<KnownCause> known_causes(const Estimate& estimate);

struct Plan {
  std::vector<PlannedChannel> channels;   // as Measurement::results
  std::vector<ExposureAdvice> exposures;  // of every shot and channel, in the rig's order
  std::vector<OtherShots> other_shots;    // of every material, of its least known channel
  bool from_truth = true;                 // else: the range of the options
  bool brightness_known = true;           // the rig has a responsivity
  bool neutral_camera = false;            // see planned_rig()
  bool calibrated_noise = false;          // of camera.radiance; else of camera.sensor
  std::array<SensorNoise, kRgb> noise;    // R, G, B
  std::map<std::string, double> patch_size_mm;
  std::vector<InputFile> inputs;  // rig, meshes, probes
  std::vector<std::pair<std::string, double>> timing_s;
  bool any_refused() const;  // at a corner, too
};

// The rig that stands for the one that will be shot: where it names a radiance calibration but no
// truth.sensor that it would correct, its camera needs no correction, and the calibration corrects
// nothing but keeps every standard deviation.
Rig planned_rig(const Rig& rig);

// Renders the rig's shots of the expected materials by the dipole, exposes them without noise, and
// measures them as `measure --model dipole` does: rows are left out, weighed and counted alike, and
// the covariance is the estimator's own. Noise counts by the camera's noise model. Throws
// InputError for what the rig lacks or where measuring would; std::invalid_argument for a range
// that is none.
Plan plan(const Rig& rig, const PlanOptions& options = {}, Progress* progress = nullptr);
// The same with objects that are open already; without Plan::inputs.
Plan plan(const Rig& rig, const ObjectScenes& objects, const PlanOptions& options);

// What the forecast takes for granted, in sentences.
std::vector<std::string> plan_assumptions(const Plan& plan);

// Deviations of one coefficient over the expected medium and the corners, relative to the value;
// NaN where there are none.
struct RelativeRange {
  double low = 0;
  double high = 0;
};
RelativeRange relative_range(const PlannedChannel& channel, Quantity Estimate::*coefficient);

// "2.5 %"; a dash where there is none, and "2 … 3.5 %" for a range.
std::string percent_text(double relative);
std::string percent_text(const RelativeRange& range);

}  // namespace scattermeter::apps
