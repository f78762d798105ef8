// The images that the dipole is fitted to, one shot of a channel at a time.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/diffusion/distance_weights.h"
#include "core/estimation/channel_rows.h"
#include "core/estimation/nuisances.h"
#include "core/fit/image_rows.h"

namespace scattermeter {

// The used rows of the channel under all their lights, with all that the rig states only to a
// standard deviation (core/estimation/nuisances.h) and with the errors of the method
// (core/fit/method_errors.h). What it is made of must outlive it, the rows as well: those that are
// left out later are gone from the image. Nuisances of the rig that together can move no result by
// more than a hundredth of the deviation that the noise alone causes are left out: the length of
// what one deviation of them changes, in deviations of the rows, is a bound for that.
class ChannelImage final : public ImageRows {
 public:
  // first: the material as known so far, for which nuisances and errors are computed.
  // sensitivities: of every view and light of the channel. patch_mm: of the patches whose errors
  // these are; absent: the channel's.
  ChannelImage(const Scene& scene, const MaterialChannel& channel, const ChannelRows& rows,
               const Weights& weights, const DistanceKnots& knots, const LitMedium& first,
               const std::map<LightKey, ChannelSensitivity>& sensitivities,
               std::optional<double> patch_mm = std::nullopt);
  std::size_t shots() const override { return channel_.shots.size(); }
  const std::vector<Nuisance>& nuisances() const override { return nuisances_; }
  ShotSystem shot(std::size_t shot) const override;
  std::size_t negligible_nuisances() const { return negligible_; }

 private:
  // With the errors of the method alone.
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
  std::map<std::string, Eigen::Index> index_;  // of the rig's, by name
  std::size_t negligible_ = 0;                 // of the rig's, that are in neither
  Eigen::Index octaves_ = 0;                   // errors of the method that the shots share
};

// The same before anything is known of the material: no nuisances but ambient light, which is
// a free constant in the shots that it falls into (on a body without hollows it is nearly that).
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
