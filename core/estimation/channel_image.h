// The images of one channel to which the dipole is fitted, one shot at a time.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/diffusion/distance_weights.h"
#include "core/estimation/channel_rows.h"
#include "core/fit/image_rows.h"
#include "core/nuisances/nuisances.h"

namespace scattermeter {

// The used rows of the channel under all their lights, with the setup's uncertain quantities
// (core/nuisances/nuisances.h) and the errors of the method (core/fit/method_errors.h) as
// nuisances. All arguments must outlive it; rows excluded from `rows` later are also excluded from
// the image. Nuisances of the setup that together cannot change any result by more than a hundredth
// of its deviation by noise alone are left out: the length of the image's change by one deviation
// of them, in deviations of the rows, is a bound of this.
class ChannelImage final : public ImageRows {
 public:
  // first: the material as first estimated, for which nuisances and errors are computed.
  // sensitivities: for every view and light of the channel. patch_mm: the patch size for the errors
  // of the method; absent: the channel's.
  ChannelImage(const Scene& scene, const MaterialChannel& channel, const ChannelRows& rows,
               const Weights& weights, const DistanceKnots& knots, const LitMedium& first,
               const std::map<LightKey, ChannelSensitivity>& sensitivities,
               std::optional<double> patch_mm = std::nullopt);
  std::size_t shots() const override { return channel_.shots.size(); }
  const std::vector<Nuisance>& nuisances() const override { return nuisances_; }
  ShotSystem shot(std::size_t shot) const override;
  std::size_t negligible_nuisances() const { return negligible_; }
  // Of all shots: the light by way of the plane below the objects that has been subtracted from l.
  Eigen::VectorXd light_by_plane() const;

 private:
  // With the errors of the method only.
  DenseSystem rows_of_shot(std::size_t shot) const;
  void add_errors_of_method(DenseSystem& system) const;

  const Scene& scene_;
  const MaterialChannel& channel_;
  const ChannelRows& rows_;
  const Weights& weights_;
  const DistanceKnots& knots_;
  LitMedium first_;
  Eigen::VectorXd r_;  // of that material, times the scale, on the knots
  SceneNuisances scene_nuisances_;
  std::optional<double> patch_mm_;
  std::vector<Nuisance> nuisances_;
  std::map<std::string, Eigen::Index> index_;  // of the setup's nuisances, by name
  std::size_t negligible_ = 0;                 // of the setup's, in neither list
  Eigen::Index octaves_ = 0;                   // errors of the method common to the shots
};

// The same before anything is known of the material: no nuisances except ambient light, which is a
// free constant in the shots that include it (nearly true on a convex body).
class FirstChannelImage final : public ImageRows {
 public:
  FirstChannelImage(const Scene& scene, const MaterialChannel& channel, const ChannelRows& rows,
                    const Weights& weights);
  std::size_t shots() const override { return channel_.shots.size(); }
  const std::vector<Nuisance>& nuisances() const override { return nuisances_; }
  ShotSystem shot(std::size_t shot) const override;

 private:
  const Scene& scene_;
  const MaterialChannel& channel_;
  const ChannelRows& rows_;
  const Weights& weights_;
  double mean_l_ = 0;
  std::vector<bool> has_ambient_;  // by shot
  std::vector<Nuisance> nuisances_;
};

}  // namespace scattermeter
