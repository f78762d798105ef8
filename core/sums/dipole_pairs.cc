#include "core/sums/dipole_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/sums/dipole_kernels.h"

namespace scattermeter {

DipoleSum dipole_sum(const Medium& medium, const PoleSum& poles) {
  // As in Dipole::with_derivatives.
  const double s = medium.sigma_s_prime_per_mm;
  const double a = medium.sigma_a_per_mm;
  const double t = s + a;
  const double albedo = s / t;
  const double d_sigma_t = -poles.z_d_z / t;
  constexpr double kScale = 1.0 / (4.0 * std::numbers::pi);
  return {kScale * albedo * poles.value,
          kScale * (a / (t * t) * poles.value + albedo * (d_sigma_t + 3.0 * a * poles.d_kappa2)),
          kScale *
              (-s / (t * t) * poles.value + albedo * (d_sigma_t + 3.0 * (t + a) * poles.d_kappa2))};
}

PairSources::PairSources(std::span<const Eigen::Vector3d> points_mm,
                         std::span<const double> weights)
    : size_(points_mm.size()) {
  if (weights.size() != size_) throw std::invalid_argument("PairSources: points and weights");
  for (std::vector<float>* v : {&x_, &y_, &z_, &c_}) v->reserve(size_);
  for (std::size_t first = 0; first < size_; first += kBlock) {
    const std::size_t count = std::min(kBlock, size_ - first);
    Eigen::Vector3d low = points_mm[first];
    Eigen::Vector3d high = low;
    double largest = 0.0;
    for (std::size_t i = first; i < first + count; ++i) {
      if (!points_mm[i].allFinite() || !std::isfinite(weights[i])) {
        throw std::invalid_argument("PairSources: not finite");
      }
      low = low.cwiseMin(points_mm[i]);
      high = high.cwiseMax(points_mm[i]);
      largest = std::max(largest, std::abs(weights[i]));
    }
    if (largest == 0.0) continue;
    const Block block{0.5 * (low + high), largest, x_.size(), count};
    for (std::size_t i = first; i < first + count; ++i) {
      const Eigen::Vector3f p = (points_mm[i] - block.origin_mm).cast<float>();
      x_.push_back(p.x());
      y_.push_back(p.y());
      z_.push_back(p.z());
      c_.push_back(static_cast<float>(weights[i] / largest));
    }
    blocks_.push_back(block);
  }
}

DipolePairs::DipolePairs(const Medium& medium) : medium_(medium) {
  const Dipole dipole(medium);
  z_r_mm_ = dipole.z_r_mm();
  z_v_mm_ = dipole.z_v_mm();
  kappa_per_mm_ = dipole.sigma_tr_per_mm();
}

void DipolePairs::sum(const PairSources& sources, std::span<const Eigen::Vector3d> sites_mm,
                      std::span<DipoleSum> out) const {
  if (out.size() != sites_mm.size()) throw std::invalid_argument("DipolePairs: sites and sums");
  const KernelDipole kernel{z_r_mm_, z_v_mm_, kappa_per_mm_};
  for (std::size_t first = 0; first < sites_mm.size(); first += kRowLanes) {
    const std::size_t count = std::min(kRowLanes, sites_mm.size() - first);
    RowLanes rows;
    for (std::size_t i = 0; i < kRowLanes; ++i) {
      const Eigen::Vector3d& p = sites_mm[first + std::min(i, count - 1)];
      rows.x[i] = p.x();
      rows.y[i] = p.y();
      rows.z[i] = p.z();
    }
    LaneSums sums{};
    for (const PairSources::Block& b : sources.blocks_) {
      const KernelPoints points{{b.origin_mm.x(), b.origin_mm.y(), b.origin_mm.z()},
                                &sources.x_[b.first],
                                &sources.y_[b.first],
                                &sources.z_[b.first],
                                &sources.c_[b.first],
                                b.count};
      add_point_sums({&kernel, 1}, rows, {&points, 1}, b.weight, {&sums, 1});
    }
    for (std::size_t i = 0; i < count; ++i) {
      out[first + i] = dipole_sum(medium_, {sums.value[i], sums.z_d_z[i], -0.5 * sums.decay[i]});
    }
  }
}

}  // namespace scattermeter
