// Change of a channel's light by the refractive index, as paths show it.
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/estimation/channel_rows.h"
#include "core/estimation/material_channel.h"
#include "core/fit/shot_parts.h"
#include "core/transport/scattering_rows.h"

namespace scattermeter {

// Per unit of eta at the same sigma_s' and sigma_a, of predicted minus observed l (both depend on
// it). The index decides how much of the light inside the surface sends back; what that does to a
// body's light, the dipole of a half-space knows neither in size nor in sign: of cubes and
// pyramids, its change shifts sigma_a where paths shift sigma_s'. The noise of the change that
// paths show would look like structure that tells eta from all else. Hence the column of eta is
// what is left of the change, expressed by that of the dipole and by changes of scale, sigma_s' and
// sigma_a, without the changes of the medium, which cannot be told from it: of a cube, it is nearly
// a change of sigma_s' by 1 % for 0.01 of eta. All that paths show beyond the column is
// DenseSystem::beyond_column.
class EtaNuisance {
 public:
  // by_dipole: the change of the rows whose state is kUsed, shot by shot. The channel must outlive
  // the object.
  EtaNuisance(const MaterialChannel& channel, Eigen::VectorXd by_dipole)
      : channel_(channel), by_dipole_(std::move(by_dipole)) {}

  // From now on, changes have these rows. kept: their indices among those so far.
  void set_rows(const ChannelRows& rows, const std::vector<Eigen::Index>& kept);
  // smooth: the image without noise; paths, per_eta: the light of paths and its change by eta. All
  // by row, at scale 1; `scale` is that of the point. The sum of terms is the one closest to the
  // change in the light of the shots' parts.
  Eigen::VectorXd column(const ShotParts& parts, const ScatteringImage& smooth, double scale,
                         bool scale_is_free, const Eigen::VectorXd& paths,
                         const Eigen::VectorXd& per_eta) const;
  // All of the change, with the noise of paths.
  Eigen::VectorXd change(const ScatteringImage& smooth, double scale,
                         const Eigen::VectorXd& per_eta) const {
    return scale * (per_eta - observed_.cwiseProduct(smooth.l));
  }

 private:
  const MaterialChannel& channel_;
  Eigen::VectorXd by_dipole_;
  Eigen::VectorXd observed_;  // of the observed l, relative to it
};

}  // namespace scattermeter
