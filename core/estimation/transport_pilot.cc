#include "core/estimation/transport_pilot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/diffusion/dipole_curve.h"
#include "core/material/fresnel.h"

namespace scattermeter {

ScatteringImage dipole_pilot(const WeightMatrix& weights, const DistanceKnots& knots,
                             const ScatteringPoint& at, double eta_int_over_ext) {
  const double sigma_t = at.sigma_s_per_mm + at.sigma_a_per_mm;
  const double albedo = at.sigma_s_per_mm / sigma_t;
  const DipoleCurve curve = dipole_curve(knots, std::log(sigma_t), 1.0 - albedo, eta_int_over_ext);
  ScatteringImage out;
  out.l = weights * curve.r;
  const Eigen::VectorXd d_u = weights * curve.d_u;
  const Eigen::VectorXd d_q = weights * curve.d_q;
  out.per_log_sigma_s = albedo * d_u - albedo * (1.0 - albedo) * d_q;
  out.per_sigma_a = (d_u + albedo * d_q) / sigma_t;
  return out;
}

ScatteringImage mean_of(const ScatteringImage& a, const ScatteringImage& b) {
  return {0.5 * (a.l + b.l), 0.5 * (a.per_log_sigma_s + b.per_log_sigma_s),
          0.5 * (a.per_sigma_a + b.per_sigma_a), 0.5 * (a.variance + b.variance)};
}

Eigen::VectorXd smooth_path_variance(const Eigen::VectorXd& l, const std::vector<double>& area_mm2,
                                     const Eigen::VectorXd& noisy_variance) {
  const Eigen::Map<const Eigen::VectorXd> area(area_mm2.data(), l.size());
  const Eigen::VectorXd share = l.cwiseMax(0.0).cwiseQuotient(area);
  return share * (noisy_variance.sum() / share.sum());
}

Eigen::MatrixXd further_images(const ShotParts& parts, const ScatteringImage& image, bool is_free) {
  Eigen::MatrixXd out(image.l.size(), is_free ? 2 : 3);
  out.col(0) = parts.levelled(image.l, image.per_log_sigma_s);
  out.col(1) = parts.levelled(image.l, image.per_sigma_a);
  if (!is_free) out.col(2) = image.l;
  return out;
}

Eigen::MatrixXd expected_coefficients(bool is_free) {
  const Eigen::Index unknowns = is_free ? 3 : 2;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(5, unknowns);
  for (Eigen::Index u = 0; u < 2; ++u) out(u, u) = out(unknowns + u, u) = 0.5;
  if (is_free) out(2, 2) = 1.0;
  return out;
}

double variance_by_learning(int blocks) {
  constexpr double kLearningBlocks = 64.0;
  return 1.0 + kLearningBlocks / std::max(1, blocks);
}

bool PathPilots::have_learned() const {
  constexpr double kBlocks = 32.0;
  return light_[0].blocks() >= kBlocks;
}

void PathPilots::learn(const ShotParts& parts, const ChannelSimulation::Look& seen,
                       const std::array<Eigen::MatrixXd, 2>& cells, const ScatteringImage& dipole) {
  for (std::size_t half = 0; half < 2; ++half) {
    light_[half].learn(parts, seen.halves[half], cells[half], 0.5 * seen.freedom, dipole,
                       seen.blocks);
  }
  PartLight::confirm(light_[0], light_[1]);
}

std::array<TransportRound::Pilot, 2> PathPilots::pilots(const ShotParts& parts,
                                                        const ScatteringImage& dipole,
                                                        const std::vector<double>& area_mm2,
                                                        const Eigen::VectorXd& noisy_variance,
                                                        double of_block) const {
  std::array<TransportRound::Pilot, 2> out;
  for (std::size_t half = 0; half < 2; ++half) {
    ScatteringImage& image = out[half].image;
    image = dipole;
    if (have_learned()) light_[half].correct(parts, image);
    image.variance = smooth_path_variance(image.l, area_mm2, noisy_variance);
    out[half].cells = of_block * light_[half].relative_cell_covariance(parts);
  }
  return out;
}

DenseSystem system_of_paths(const DipoleSystem& dipole, double gamma_std, bool is_rough) {
  DenseSystem system = dipole.system();
  if (dipole.light_by_plane) system.l += dipole.light_by_plane();
  std::vector<Eigen::Index> kept;
  std::vector<Nuisance> nuisances = {{"phase function", gamma_std, true, "gamma"}};
  if (is_rough) nuisances.push_back({"roughness", 1.0, true, "roughness"});
  const auto own = static_cast<Eigen::Index>(nuisances.size());
  for (std::size_t k = 0; k < system.nuisances.size(); ++k) {
    if (system.nuisances[k].group == "camera shift") continue;
    kept.push_back(static_cast<Eigen::Index>(k));
    nuisances.push_back(system.nuisances[k]);
  }
  Eigen::MatrixXd columns(system.l.size(), static_cast<Eigen::Index>(nuisances.size()));
  columns.leftCols(own).setZero();
  if (!kept.empty()) {
    columns.rightCols(columns.cols() - own) = system.nuisance_columns(Eigen::all, kept);
  }
  system.nuisances = std::move(nuisances);
  system.nuisance_columns = std::move(columns);
  return system;
}

// Of the dipole's image, only A knows eta: the derivative by ln A is that by eta over that of ln A.
Eigen::VectorXd roughness_change(const RoughSurfaces& surfaces, const WeightMatrix& weights,
                                 const DistanceKnots& knots, const ScatteringPoint& at,
                                 double eta_int_over_ext) {
  constexpr double kStep = 0.01;
  const auto l_with = [&](double eta) { return dipole_pilot(weights, knots, at, eta).l; };
  const double more = eta_int_over_ext + kStep;
  const double less = std::max(1.0, eta_int_over_ext - kStep);
  const double log_mismatch = std::log(boundary_mismatch(more) / boundary_mismatch(less));
  return at.scale *
         surfaces.change(l_with(eta_int_over_ext), (l_with(more) - l_with(less)) / log_mismatch);
}

}  // namespace scattermeter
