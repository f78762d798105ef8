// How the image depends on what the rig knows only to a standard deviation.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <Eigen/Core>

#include "apps/light_sensitivity.h"
#include "apps/rig_lens.h"
#include "apps/shot_system.h"
#include "core/linear_shot.h"

namespace scattermeter::apps {

// Sensitivities by (view, light, channel; 0 for an LED), and which column of theirs belongs to a
// task.
using LightKey = std::tuple<const SeenObject*, std::string, std::size_t>;
using ChangedWeightsByLight = std::map<LightKey, ChangedWeights>;
struct TaskSensitivity {
  const LightSensitivity* sensitivity;
  Eigen::Index medium;
};

// One nuisance and dl/dv on rows of a shot.
struct NuisanceColumn {
  Nuisance nuisance;  // its name is its own in all the rig
  Eigen::VectorXd change;
};

// The nuisances that the rig leaves open: place, exponent and power of every LED in use, or,
// where a calibration gives their covariance, seven independent combinations of them and the axis
// ("LED calibration"), and one common to all LEDs that were calibrated with a white plane; power of
// every environment, pose (six independent combinations of each pose's covariance), lens (as many
// as its calibration has parameters, alike in all shots; each takes along what the pose, which was
// fitted through that lens, would have become; what LEDs and scale owe to the same lens is not
// followed), eta; with a
// radiance calibration each file's black, the glare and the exposure times (files of one stated
// time share theirs; in a bracket each moves the part of a row that comes from it); those with a
// standard deviation of 0 are left out.
class RigNuisances {
 public:
  // Of one channel. sensitivities: of every view and light that is asked for.
  RigNuisances(const Rig& rig, std::size_t channel,
               std::map<LightKey, TaskSensitivity> sensitivities);
  // Of some rows of a shot's map, ascending; which they are depends on the shot alone.
  std::vector<NuisanceColumn> columns(const OpenedShot& shot, const ChannelObservation& observed,
                                      const std::vector<Eigen::Index>& rows) const;

 private:
  // The rows of an LED's covariance that one channel sees.
  static constexpr Eigen::Index kSeen = 7;
  using SeenMatrix = Eigen::Matrix<double, kSeen, kSeen>;
  class Columns;

  void add_light(const RigLight& light, double intensity, const TaskSensitivity& task,
                 Columns& columns) const;
  void add_calibrated(const RigLight& light, double intensity, const TaskSensitivity& task,
                      Columns& columns) const;
  void add_view(const OpenedShot& shot, const Eigen::Matrix3Xd& per_mm, Columns& columns) const;
  void add_radiance(const OpenedShot& shot, const ChannelObservation& observed,
                    const Eigen::VectorXd& predicted, Columns& columns) const;

  const Rig& rig_;
  std::size_t channel_;
  std::map<LightKey, TaskSensitivity> sensitivities_;
  std::map<std::string, SeenMatrix> led_root_;  // of calibrated LEDs
  LensRoot lens_root_;
};

}  // namespace scattermeter::apps
