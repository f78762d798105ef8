// How the image depends on what the rig knows only to a standard deviation.
#pragma once

#include <array>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "apps/rig_lens.h"
#include "apps/shot_system.h"
#include "core/distance_weights.h"
#include "core/linear_shot.h"
#include "core/medium.h"

namespace scattermeter::apps {

// A material, as first estimated, seen under one light in one view.
struct LitMedium {
  Medium medium;
  double scale = 1;  // measured over predicted, of the first estimate
};

// Change of l (per unit of the light's power) on the rows of a view for each medium: rows x media.
// Empty where the rig knows the quantity exactly.
struct LightSensitivity {
  Eigen::MatrixXd l;                       // nominal
  std::array<Eigen::MatrixXd, 3> per_mm;   // by the LED's position, world x, y, z
  Eigen::MatrixXd per_exponent;            // by the lobe's exponent; of an LED only, too
  std::array<Eigen::MatrixXd, 2> per_rad;  // by turning the axis towards the calibration's tangents
  Eigen::MatrixXd per_eta;                 // by eta, of l - observed l: both depend on it
  std::array<Eigen::MatrixXd, 2> per_tangent_mm;  // by moving the sites along two tangents
};

// For weights to some 1e-3: deviations need no more.
PairSumOptions coarse_pair_options(const DistanceKnots& knots);

// A view under a light, nominal and with one thing changed at a time. At the centres of the sites,
// from light on patches of twice the size: errors of discretisation cancel in relative changes, and
// these are nearly the same all over a site. What the rig knows exactly is not changed (no rows).
template <class Each>
struct Changed {
  Each nominal;
  std::array<Each, 3> moved;  // the LED, by move_mm along world x, y, z
  double move_mm = 0;
  Each other_exponent;
  std::array<Each, 2> turned;  // the axis, by turn_rad along the calibration's tangents
  double turn_rad = 0;
  Each other_eta;
  std::array<Each, 2> shifted;  // the sites, by shift_mm along two tangents
  double shift_mm = 0;
};
// W: all that the sensitivities of any medium need of the geometry.
using ChangedWeights = Changed<WeightMatrix>;
// The images themselves of some media, rows x media: as many numbers as W has knots times fewer.
using ChangedImages = Changed<Eigen::MatrixXd>;
// `channel`: of the library's light.
ChangedWeights changed_weights(const SeenObject& seen, const RigLight& light, std::size_t channel,
                               ObjectLibrary& library, const DistanceKnots& knots);
ChangedImages changed_images(const SeenObject& seen, const RigLight& light, std::size_t channel,
                             ObjectLibrary& library, const DistanceKnots& knots,
                             const std::vector<LitMedium>& media);
ChangedImages changed_images(const SeenObject& seen, const ChangedWeights& weights,
                             const DistanceKnots& knots, const std::vector<LitMedium>& media);

// By differences of the changed images and the nominal ones, relative to what `nominal`, the W
// that is measured with, predicts of the same media.
LightSensitivity sensitivity(const SeenObject& seen, const WeightMatrix& nominal,
                             const ChangedImages& images, const std::vector<LitMedium>& media,
                             const DistanceKnots& knots);

// Two unit tangents of a row's facet; per_tangent_mm goes along them.
std::array<Eigen::Vector3d, 2> tangents(const Eigen::Vector3d& normal);

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
