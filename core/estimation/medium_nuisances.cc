#include "core/estimation/medium_nuisances.h"

#include <algorithm>

#include "core/estimation/transport_pilot.h"

namespace scattermeter {
namespace {

Eigen::Index column_of_eta(const DenseSystem& system) {
  const auto eta = std::find_if(system.nuisances.begin(), system.nuisances.end(),
                                [](const Nuisance& n) { return n.name == "eta"; });
  return eta == system.nuisances.end() ? -1 : eta - system.nuisances.begin();
}

}  // namespace

MediumNuisances::MediumNuisances(const Scene& scene, const MaterialChannel& channel,
                                 const DistanceKnots& knots, const DenseSystem& system)
    : channel_(channel),
      knots_(knots),
      phase_(scene, channel, knots_),
      eta_column_(column_of_eta(system)),
      eta_(channel, eta_column_ < 0 ? Eigen::VectorXd::Zero(system.l.size()).eval()
                                    : system.nuisance_columns.col(eta_column_).eval()) {}

void MediumNuisances::set_rows(const ChannelRows& rows, const std::vector<Eigen::Index>& kept) {
  phase_.set_rows(rows);
  eta_.set_rows(rows, kept);
}

void MediumNuisances::set_columns(const ScatteringPoint& at, bool scale_is_free,
                                  const RoughSurfaces& surfaces, const ShotParts& parts,
                                  const ScatteringImage& smooth, const Eigen::VectorXd& paths,
                                  const Eigen::VectorXd& per_eta, DenseSystem& system) const {
  Eigen::MatrixXd& columns = system.nuisance_columns;
  columns.col(0) = phase_.change(system.weights, at);
  if (channel_.surface_alpha_std > 0.0) {
    columns.col(1) =
        roughness_change(surfaces, system.weights, knots_, at, channel_.eta_int_over_ext);
  }
  if (eta_column_ < 0) return;
  columns.col(eta_column_) = eta_.column(parts, smooth, at.scale, scale_is_free, paths, per_eta);
  see_eta(smooth, at.scale, per_eta, system);
}

void MediumNuisances::see_eta(const ScatteringImage& smooth, double scale,
                              const Eigen::VectorXd& per_eta, DenseSystem& system) const {
  if (eta_column_ < 0) return;
  system.beyond_column = {
      eta_column_, eta_.change(smooth, scale, per_eta) - system.nuisance_columns.col(eta_column_)};
}

}  // namespace scattermeter
