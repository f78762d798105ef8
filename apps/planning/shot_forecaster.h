// Predicted uncertainties of shots that need not be in the rig: linearised, on coarse patches,
// without rendering.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/instrument/open_shots.h"
#include "capture/sensor/noise_model.h"
#include "core/camera/sensor_noise.h"
#include "core/diffusion/distance_weights.h"
#include "core/estimation/estimation.h"
#include "core/material/medium.h"
#include "core/mesh/ray_scene.h"
#include "core/nuisances/nuisances.h"
#include "core/view/observation.h"

namespace scattermeter::apps {

// The weights W of each view under each light, and their changes with the parameters of the light.
struct ViewWeights {
  Weights weights;
  ChangedWeightsByLight changed;
};

// A shot of the rig or one that could be added to it.
struct CandidateShot {
  SceneShot stated;  // file, object, material, lights
  std::shared_ptr<const SeenObject> seen;
  // An opened shot of the same camera, for the pose and the uncertainties of its calibration.
  const ObservedShot* like = nullptr;
  // One per file, s; empty: a single one that takes the brightest row to three quarters of the
  // range, but at most 30 s.
  std::vector<double> exposures_s;
};

struct ExpectedMaterial {
  std::string name;
  std::size_t channel = 0;  // of the forecast
  std::array<Medium, kRgb> media;
  double eta = 0;
};

// Standard deviations of sigma_s' and sigma_a, 1/mm.
struct ForecastStd {
  double sigma_s_prime_per_mm = 0;
  double sigma_a_per_mm = 0;
};

class ShotForecaster {
 public:
  // `rig`, `objects` and `opened` must outlive it. measured_patch_mm: size of the patches that will
  // be used for measuring, for the errors of the method. responsivity: counts per (W/(mm^2 sr)) and
  // second; noise: of the sensor, by channel.
  ShotForecaster(const Rig& rig, const ObjectScenes& objects,
                 const std::vector<ObservedShot>& opened, double patch_size_mm,
                 double measured_patch_mm, const std::array<double, kRgb>& responsivity,
                 const std::array<SensorNoise, kRgb>& noise, double range_counts);

  // The opened shots of a material.
  std::vector<CandidateShot> shots_of(const std::string& material) const;
  // Adds the weights of the shots' views and lights. Must not be called from several threads at
  // once.
  void add_lights(const std::vector<CandidateShot>& shots, ViewWeights& lit);

  std::shared_ptr<const SeenObject> seen(const std::string& object) const;
  // Adds the weights of an LED that need not be in the rig. Returns false if it reaches no part of
  // the object. May be called from several threads at once, like forecast().
  bool add_led(const SeenObject& seen, const SceneLight& led, ViewWeights& lit);

  // `rig`: that of the constructor, possibly with more lights. Excludes rows that mirror a light,
  // clip or are lost in noise. noise_inflation: factor on the variances. Returns nullopt if fewer
  // than 20 rows are left or a standard deviation is not finite.
  std::optional<ForecastStd> forecast(const Rig& rig, const ExpectedMaterial& material,
                                      const std::vector<CandidateShot>& shots,
                                      const ViewWeights& lit, const ScalePrior& scale,
                                      double noise_inflation = 1.0) const;

 private:
  ObservedShot open(const Rig& rig, const ExpectedMaterial& material, const CandidateShot& shot,
                    const ViewWeights& lit) const;

  const Rig& rig_;
  const std::vector<ObservedShot>& opened_;
  double measured_patch_mm_;
  LitObjects lit_;
  SharedView view_;
  DistanceKnots knots_;
  double range_counts_;
  std::map<std::string, Observation> per_second_;  // by object: a uniform picture, 1 s
};

}  // namespace scattermeter::apps
