// How the image depends on what the rig states only to a standard deviation.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <Eigen/Core>

#include "core/estimation/light_sensitivity.h"
#include "core/fit/linear_shot.h"
#include "core/scene/observed_shot.h"

namespace scattermeter {

// Sensitivities by (view, light, channel; 0 for an LED), and which column of theirs belongs to a
// material in a channel.
using LightKey = std::tuple<const SeenObject*, std::string, std::size_t>;
using ChangedWeightsByLight = std::map<LightKey, ChangedWeights>;
struct ChannelSensitivity {
  const LightSensitivity* sensitivity;
  Eigen::Index medium;
};

// One nuisance and dl/dv on rows of a shot.
struct NuisanceColumn {
  Nuisance nuisance;  // its name is its own in all the rig
  Eigen::VectorXd change;
};

// The nuisances that the scene leaves open: those of every light in use (Light::nuisances()), pose
// (six independent combinations of each pose's covariance), lens (as many as its calibration has
// parameters, alike in all shots; each takes along what the pose, which was fitted through that
// lens, would have become; what LEDs and scale owe to the same lens is not followed), eta; each
// file's black, the glare and the exposure times (files of one stated time share theirs; in a
// bracket each moves the part of a row that comes from it). Those with a standard deviation of 0
// are left out.
class SceneNuisances {
 public:
  // Of one channel. sensitivities: of every view and light that is asked for.
  SceneNuisances(const Scene& scene, std::size_t channel,
                 std::map<LightKey, ChannelSensitivity> sensitivities);
  // Of some rows of a shot's map, ascending; which they are depends on the shot alone.
  std::vector<NuisanceColumn> columns(const ObservedShot& shot, const ChannelObservation& observed,
                                      const std::vector<Eigen::Index>& rows) const;

 private:
  class Columns;

  void add_light(const SceneLight& light, const ChannelSensitivity& own, Columns& columns) const;
  void add_view(const ObservedShot& shot, const Eigen::Matrix3Xd& per_mm, Columns& columns) const;
  void add_radiance(const ObservedShot& shot, const ChannelObservation& observed,
                    const Eigen::VectorXd& predicted, Columns& columns) const;

  const Scene& scene_;
  std::size_t channel_;
  std::map<LightKey, ChannelSensitivity> sensitivities_;
};

}  // namespace scattermeter
