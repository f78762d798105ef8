#include "core/sums/series_kernels.h"

#include <cstddef>
#include <numbers>

#include <hwy/cache_control.h>

// The file is compiled once for each instruction set (core/sums/CMakeLists.txt).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/sums/series_kernels.cc"
#include <hwy/foreach_target.h>
// This comes after it.
#include <hwy/highway.h>

#include "core/sums/kernel_vectors.inc"
// And this after that.
#include "core/sums/monomials.inc"

HWY_BEFORE_NAMESPACE();
namespace scattermeter::HWY_NAMESPACE {

// nearest2 / s, relative error at most 4e-4.
HWY_INLINE V quotient(V nearest2, V s) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  return hn::Mul(nearest2, hn::ApproximateReciprocal(s));
#else
  return hn::Div(nearest2, s);
#endif
}

// Adds to term[q] what the monomials of degree k in r give.
template <int k, int kDegree, bool kPlanar>
HWY_INLINE void add_terms(V x, V y, V z, const V* below, const float* coefficients, V* term) {
  if constexpr (k <= kDegree) {
    V mono[monomials_of_degree(k, kPlanar)];
    raise<kPlanar>(k, x, y, z, below, mono);
    constexpr int kTop = (kDegree - k) / 2;
    constexpr std::size_t kFrom[] = {
        coefficient_index(k, 0, kPlanar), coefficient_index(k + 2, 1, kPlanar),
        coefficient_index(k + 4, 2, kPlanar), coefficient_index(k + 6, 3, kPlanar)};
    V acc[kTop + 1];
    for (int m = 0; m <= kTop; ++m) acc[m] = term[k + m];
    for (std::size_t j = 0; j < monomials_of_degree(k, kPlanar); ++j) {
      const V v = mono[j];
      for (int m = 0; m <= kTop; ++m) {
        acc[m] = hn::MulAdd(v, set(coefficients[kFrom[m] + j]), acc[m]);
      }
    }
    for (int m = 0; m <= kTop; ++m) term[k + m] = acc[m];
    add_terms<k + 1, kDegree, kPlanar>(x, y, z, mono, coefficients, term);
  }
}

template <int kDegree, bool kPlanar>
void cluster_sums(const KernelDipole* media, std::size_t n_media, const RowLanes& rows,
                  const KernelCluster& c, double unit, LaneSums* sums) {
  const D d;
  constexpr int kTerms = kDegree == 1 ? 1 : kDegree + 1;
  const double per_radius = 1.0 / c.radius_mm;
  for (std::size_t i = 0; i < kRowLanes; i += hn::Lanes(d)) {
    V x = offsets_from(rows.x + i, c.center_mm[0], per_radius);
    V y = offsets_from(rows.y + i, c.center_mm[1], per_radius);
    V z = offsets_from(rows.z + i, c.center_mm[2], per_radius);
    const V r2 = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
    V term[kTerms];
    term[0] = set(c.coefficients[0]);
    if constexpr (kDegree > 1) {
      turn(c.frame, x, y, z);
      for (int q = 1; q < kTerms; ++q) term[q] = hn::Zero(d);
      // Powers of |D|^2 alone.
      for (int m = 1; 2 * m <= kDegree; ++m) {
        term[m] = set(c.coefficients[coefficient_index(2 * m, m, kPlanar)]);
      }
      const V one = set(1.0F);
      add_terms<1, kDegree, kPlanar>(x, y, z, &one, c.coefficients, term);
    }
    for (std::size_t medium = 0; medium < n_media; ++medium) {
      const double kappa = media[medium].kappa_per_mm * c.radius_mm;
      const V kappa2 = set(kappa * kappa);
      V value = hn::Zero(d), z_d_z = hn::Zero(d), decay = hn::Zero(d);
      for (const double depth_mm : {media[medium].z_r_mm, media[medium].z_v_mm}) {
        const double depth = depth_mm * per_radius;
        const V s = hn::Add(r2, set(depth * depth));
        const V q = inverse_root(s);
        const V t = hn::Mul(set(kappa * std::numbers::log2e), hn::Mul(s, q));
        const V e = exp2_of_minus(t);
        const V q2 = hn::Mul(q, q);
        const V k2 = hn::Mul(kappa2, q2);
        V psi0 = q;
        V psi1 = hn::Mul(hn::MulAdd(set(std::numbers::ln2_v<float>), t, set(1.0F)), hn::Mul(q, q2));
        V a0 = hn::Zero(d), a1 = hn::Zero(d), a2 = hn::Zero(d);
        for (int k = 0; k < kTerms; ++k) {
          const V psi2 =
              hn::MulAdd(hn::Mul(set(static_cast<float>(2 * k + 3)), q2), psi1, hn::Mul(k2, psi0));
          a0 = hn::MulAdd(psi0, term[k], a0);
          a1 = hn::MulAdd(psi1, term[k], a1);
          a2 = hn::MulAdd(psi2, term[k], a2);
          psi0 = psi1;
          psi1 = psi2;
        }
        const V ze = hn::Mul(set(depth), e);
        value = hn::MulAdd(ze, a1, value);
        z_d_z = hn::MulAdd(ze, hn::NegMulAdd(set(depth * depth), a2, a1), z_d_z);
        decay = hn::MulAdd(ze, a0, decay);
      }
      const double per_area = unit * per_radius * per_radius;
      add_lanes(value, per_area, sums[medium].value + i);
      add_lanes(z_d_z, per_area, sums[medium].z_d_z + i);
      add_lanes(decay, unit, sums[medium].decay + i);
    }
  }
}

template <bool kPlanar>
void cluster_sums_of(const KernelDipole* media, std::size_t n_media, const RowLanes& rows,
                     const KernelCluster& c, int degree, double unit, LaneSums* sums) {
  switch (degree) {
    case 1:
      return cluster_sums<1, kPlanar>(media, n_media, rows, c, unit, sums);
    case 2:
      return cluster_sums<2, kPlanar>(media, n_media, rows, c, unit, sums);
    case 4:
      return cluster_sums<4, kPlanar>(media, n_media, rows, c, unit, sums);
    case 6:
      return cluster_sums<6, kPlanar>(media, n_media, rows, c, unit, sums);
    default:
      return cluster_sums<8, kPlanar>(media, n_media, rows, c, unit, sums);
  }
}

void add_cluster_sums_here(const KernelDipole* media, std::size_t n_media, const RowLanes& rows,
                           const KernelSeries* series, std::size_t n_series, LaneSums* sums) {
  for (const KernelSeries* s = series; s != series + n_series; ++s) {
    // Frame and coefficients are far away in memory.
    constexpr std::ptrdiff_t kAhead = 3;
    if (series + n_series - s > kAhead) {
      const float* const next = s[kAhead].cluster.frame;
      const int lines = s[kAhead].degree > 6 && !s[kAhead].cluster.planar ? 10 : 6;
      for (int line = 0; line < lines; ++line) hwy::Prefetch(next + 16 * line);
    }
    if (s->cluster.planar) {
      cluster_sums_of<true>(media, n_media, rows, s->cluster, s->degree, s->unit, sums);
    } else {
      cluster_sums_of<false>(media, n_media, rows, s->cluster, s->degree, s->unit, sums);
    }
  }
}

void add_lane_rests_here(const RowLanes& rows, const LaneRest* rests, std::size_t n_rests,
                         double pole, double* lanes) {
  const D d;
  for (std::size_t i = 0; i < kRowLanes; i += hn::Lanes(d)) {
    for (const LaneRest* rest = rests; rest != rests + n_rests; ++rest) {
      const double per_length = 1.0 / rest->nearest_mm;
      const V x = offsets_from(rows.x + i, rest->center_mm[0], per_length);
      const V y = offsets_from(rows.y + i, rest->center_mm[1], per_length);
      const V z = offsets_from(rows.z + i, rest->center_mm[2], per_length);
      const V pole2 = set(pole * pole * per_length * per_length);
      const V s = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::MulAdd(z, z, pole2)));
      // Raised to 1e-6, so that its powers do not vanish.
      const V w = hn::Max(quotient(set(1.0F), s), set(1e-6F));
      V product = w;
      for (int k = 1; k < rest->power; ++k) product = hn::Mul(product, w);
      add_lanes(product, 1.003 * rest->largest, lanes + i);
    }
  }
}

}  // namespace scattermeter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scattermeter {
HWY_EXPORT(add_cluster_sums_here);
HWY_EXPORT(add_lane_rests_here);

void add_cluster_sums(std::span<const KernelDipole> media, const RowLanes& rows,
                      std::span<const KernelSeries> series, std::span<LaneSums> sums) {
  prepare_kernels();
  HWY_DYNAMIC_DISPATCH(add_cluster_sums_here)
  (media.data(), media.size(), rows, series.data(), series.size(), sums.data());
}

void add_lane_rests(const RowLanes& rows, std::span<const LaneRest> rests, double pole_mm,
                    double* lanes) {
  prepare_kernels();
  HWY_DYNAMIC_DISPATCH(add_lane_rests_here)
  (rows, rests.data(), rests.size(), pole_mm, lanes);
}

}  // namespace scattermeter
#endif  // HWY_ONCE
