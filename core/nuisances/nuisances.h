// The nuisances of a scene, and the image's derivatives by them.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <Eigen/Core>

#include "core/fit/linear_shot.h"
#include "core/nuisances/light_sensitivity.h"
#include "core/scene/observed_shot.h"

namespace scattermeter {

// Sensitivities by (view, light, channel; 0 for an LED), and their column for a material in a
// channel.
using LightKey = std::tuple<const SeenObject*, std::string, std::size_t>;
using ChangedWeightsByLight = std::map<LightKey, ChangedWeights>;
struct ChannelSensitivity {
  const LightSensitivity* sensitivity;
  Eigen::Index medium;
};

// One nuisance and dl/dv on rows of a shot.
struct NuisanceColumn {
  Nuisance nuisance;  // its name is unique in the setup
  Eigen::VectorXd change;
};

// The uncertain quantities of the scene: those of every light in use (Light::nuisances()); the
// objects' positions and sizes (seven, each object moved, turned and enlarged against camera and
// lights); even light on each shot; the shift of its picture; pose (six independent combinations of
// each pose's covariance); lens (as many as its calibration has parameters, common to all shots,
// each with the resulting change of the pose fitted with that lens; its effect on calibrated LEDs
// and scale is not included); eta; the gloss of a surface that is stated as smooth; the albedo of
// the plane below the object; the halo of the lens, where the background shows light beside the
// object; the fall-off of light towards the frame's corners; the response's departure from a
// straight line; each file's black level, the pedestal, glare and the exposure times (common to
// files of the same stated time; in a bracket each affects the part of a row that comes from it).
// Those with a standard deviation of 0 are left out, but for eta, which is then tested against the
// image.
class SceneNuisances {
 public:
  // Of one channel. sensitivities: for every view and light of the shots passed to columns().
  SceneNuisances(const Scene& scene, std::size_t channel,
                 std::map<LightKey, ChannelSensitivity> sensitivities);
  // The light that the plane below the object sends, at the albedo that is stated or assumed, on
  // some rows of a shot's map: part of the observed l, but not of W r. Zero without a plane.
  Eigen::VectorXd light_by_plane(const ObservedShot& shot,
                                 const std::vector<Eigen::Index>& rows) const;
  // The change of l by the shift from the pose of a shot's map back to the shot's pose
  // (SeenObject::shift), on some rows of the map: part of the observed l, but not of W r, so that
  // poses and positions keep the values about which they vary. Zero without a shift.
  Eigen::VectorXd light_by_shift(const ObservedShot& shot,
                                 const std::vector<Eigen::Index>& rows) const;
  // The change of l by the displacement of LEDs back to where they are stated
  // (Light::displacement()), on some rows of a shot's map: part of the observed l, but not of W r.
  Eigen::VectorXd light_by_displacement(const ObservedShot& shot,
                                        const std::vector<Eigen::Index>& rows) const;
  // The change of l by the blur that the shot's outline shows (DecodedShot::edge_blur), on some
  // rows of the map: part of the observed l, but not of W r.
  Eigen::VectorXd light_by_blur(const ObservedShot& shot,
                                const std::vector<Eigen::Index>& rows) const;
  // On some rows of a shot's map, ascending. Which nuisances are returned depends on the shot only.
  std::vector<NuisanceColumn> columns(const ObservedShot& shot, const ChannelObservation& observed,
                                      const std::vector<Eigen::Index>& rows) const;

 private:
  class Columns;

  // Of predicted - observed l of each row.
  struct SeenChange {
    Eigen::Matrix3Xd per_mm;         // by a shift of what its samples see, along the surface
    Eigen::Matrix3Xd per_direction;  // by a change of the unit vector towards the camera
  };
  SeenChange seen_change(const ObservedShot& shot, const std::vector<Eigen::Index>& rows) const;
  // Gradient of the predicted l along the surface, 1/mm, on some rows.
  Eigen::Matrix3Xd gradient_per_mm(const ObservedShot& shot,
                                   const std::vector<Eigen::Index>& rows) const;
  // Of l by a point spread (core/view/row_blur.h).
  Eigen::VectorXd change_by_blur(const ObservedShot& shot, const std::vector<Eigen::Index>& rows,
                                 const Eigen::Matrix2d& covariance_mm2) const;
  static Eigen::Matrix<double, Eigen::Dynamic, 6> change_by_pose(
      const ObservedShot& shot, const std::vector<Eigen::Index>& rows, const SeenChange& change);
  void add_light(const SceneLight& light, const ChannelSensitivity& own, Columns& columns) const;
  void add_view(const ObservedShot& shot, const SeenChange& change, Columns& columns) const;
  void add_place(const ObservedShot& shot, const SeenChange& change, Columns& columns) const;
  void add_blur(const ObservedShot& shot, Columns& columns) const;
  void add_even_light(const ObservedShot& shot, Columns& columns) const;
  void add_gloss(const ObservedShot& shot, Columns& columns) const;
  void add_vignetting(const ObservedShot& shot, const Eigen::VectorXd& predicted,
                      Columns& columns) const;
  void add_halo(const ObservedShot& shot, const ChannelObservation& observed,
                Columns& columns) const;
  Eigen::VectorXd change_by_albedo(const ObservedShot& shot,
                                   const std::vector<Eigen::Index>& rows) const;
  void add_radiance(const ObservedShot& shot, const ChannelObservation& observed,
                    const Eigen::VectorXd& predicted, Columns& columns) const;

  const Scene& scene_;
  std::size_t channel_;
  std::map<LightKey, ChannelSensitivity> sensitivities_;
};

}  // namespace scattermeter
