// Changes of a channel's light by what its medium and surface have beside sigma_s' and sigma_a.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/estimation/channel_rows.h"
#include "core/estimation/channel_simulation.h"
#include "core/estimation/eta_nuisance.h"
#include "core/estimation/phase_nuisance.h"

namespace scattermeter {

// The columns of phase function, roughness and eta in the system of a search by transport
// (system_of_paths()): they depend on its point.
class MediumNuisances {
 public:
  // system: of the rows whose state is kUsed, shot by shot. What it refers to must outlive the
  // object.
  MediumNuisances(const Scene& scene, const MaterialChannel& channel, const DistanceKnots& knots,
                  const DenseSystem& system);

  // From now on, systems have these rows. kept: their indices among those so far.
  void set_rows(const ChannelRows& rows, const std::vector<Eigen::Index>& kept);
  // smooth: the image at the point without noise, at scale 1; paths, per_eta: light of paths at a
  // point nearby, and its change by eta.
  void set_columns(const ScatteringPoint& at, bool scale_is_free, const RoughSurfaces& surfaces,
                   const ShotParts& parts, const ScatteringImage& smooth,
                   const Eigen::VectorXd& paths, const Eigen::VectorXd& per_eta,
                   DenseSystem& system) const;
  // What eta changes beyond its column, by all paths at the same point.
  void see_eta(const ScatteringImage& smooth, double scale, const Eigen::VectorXd& per_eta,
               DenseSystem& system) const;

 private:
  const MaterialChannel& channel_;
  DistanceKnots knots_;
  PhaseNuisance phase_;
  Eigen::Index eta_column_;  // -1: there is none
  EtaNuisance eta_;
};

}  // namespace scattermeter
