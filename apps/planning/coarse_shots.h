// What shots would tell that need not be the rig's: linearised, on coarse patches, without pixels.
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
#include "core/estimation/nuisances.h"
#include "core/material/medium.h"
#include "core/mesh/ray_scene.h"
#include "core/view/observation.h"

namespace scattermeter::apps {

// W of views under lights, and how it changes.
struct LitViews {
  Weights weights;
  ChangedWeightsByLight changed;
};

// A shot, taken or not.
struct CoarseShot {
  SceneShot rig;  // file, object, material, lights
  std::shared_ptr<const SeenObject> seen;
  // A shot that was opened, of the same camera: pose, and what its calibration leaves open.
  const ObservedShot* like = nullptr;
  // s, of its files; empty: one that takes the brightest row to three quarters of the range, 30 s
  // at most.
  std::vector<double> exposures_s;
};

struct CoarseMaterial {
  std::string name;
  std::size_t channel = 0;         // that is asked for
  std::array<Medium, kRgb> media;  // expected
  double eta = 0;
};

// Standard deviations of sigma_s' and sigma_a, 1/mm.
struct CoarseStd {
  double sigma_s_prime_per_mm = 0;
  double sigma_a_per_mm = 0;
};

class CoarseShots {
 public:
  // Rig, scenes and opened must outlive it. measured_patch_mm: of the patches that will be measured
  // on, for the errors of the method. responsivity: counts per (W/(mm^2 sr)) and second;
  // noise: of the sensor, by channel.
  CoarseShots(const Rig& rig, const ObjectScenes& scenes, const std::vector<ObservedShot>& opened,
              double patch_size_mm, double measured_patch_mm,
              const std::array<double, kRgb>& responsivity,
              const std::array<SensorNoise, kRgb>& noise, double range_counts);

  // A material's shots as the rig has them, and the light in them; not for several threads at once.
  std::vector<CoarseShot> shots_of(const std::string& material) const;
  void add_lights(const std::vector<CoarseShot>& shots, LitViews& lit);

  std::shared_ptr<const SeenObject> seen(const std::string& object) const;
  // An LED of any place on an object. False where it reaches no part of it. Safe for several
  // threads at once, as forecast() is.
  bool add_led(const SeenObject& seen, const SceneLight& led, LitViews& lit);

  // `rig`: of the constructor, or with more lights. Rows that mirror a light, clip or drown in
  // noise are left out. noise_inflation: of the variances. nullopt where fewer than 20 rows are
  // left or the deviations are not finite.
  std::optional<CoarseStd> forecast(const Rig& rig, const CoarseMaterial& material,
                                    const std::vector<CoarseShot>& shots, const LitViews& lit,
                                    const ScalePrior& scale, double noise_inflation = 1.0) const;

 private:
  ObservedShot open(const Rig& rig, const CoarseMaterial& material, const CoarseShot& shot,
                    const LitViews& lit) const;

  const Rig& rig_;
  const std::vector<ObservedShot>& opened_;
  double measured_patch_mm_;
  LitObjects library_;
  SharedView view_;
  DistanceKnots knots_;
  double range_counts_;
  std::map<std::string, Observation> per_second_;  // by object: an even picture, 1 s
};

}  // namespace scattermeter::apps
