#include "core/dipole_kernels.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include <hwy/cache_control.h>

// The baseline, AVX2 and AVX-512 are worth their build time.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/dipole_kernels.cc"
#include <hwy/foreach_target.h>
// After it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace scattermeter::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, kRowLanes>;
using V = hn::Vec<D>;

HWY_INLINE V set(float x) { return hn::Set(D(), x); }
HWY_INLINE V set(double x) { return hn::Set(D(), static_cast<float>(x)); }

// 1 / sqrt(s), relative error at most 3e-7. Domain: normal s > 0.
HWY_INLINE V inverse_root(V s) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  // 12 bits at least; a Newton step doubles them.
  const V q = hn::ApproximateReciprocalSqrt(s);
  const V sq = hn::Mul(s, q);
  const V rest = hn::NegMulAdd(sq, q, set(1.0F));
  return hn::MulAdd(hn::Mul(set(0.5F), q), rest, q);
#else
  return hn::Div(set(1.0F), hn::Sqrt(s));
#endif
}

// 2^-t for t >= 0; 2^-126 beyond 126. The polynomial is the minimax one of degree 5 on [-1/2, 1/2],
// relative error 7.5e-8.
HWY_INLINE V exp2_of_minus(V t) {
  const hn::RebindToSigned<D> di;
  const V u = hn::Neg(hn::Min(t, set(126.0F)));
  const V n = hn::Round(u);
  const V f = hn::Sub(u, n);
  V p = set(1.3276471979478776e-3F);
  p = hn::MulAdd(p, f, set(9.67554133421605e-3F));
  p = hn::MulAdd(p, f, set(5.550713273542586e-2F));
  p = hn::MulAdd(p, f, set(2.4022119723848476e-1F));
  p = hn::MulAdd(p, f, set(6.931469670647331e-1F));
  p = hn::MulAdd(p, f, set(1.0000000716546822F));
  const auto exponent = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(di, n), hn::Set(di, 127)));
  return hn::Mul(p, hn::BitCast(D(), exponent));
}

// nearest2 / s, relative error at most 4e-4.
HWY_INLINE V quotient(V nearest2, V s) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  return hn::Mul(nearest2, hn::ApproximateReciprocal(s));
#else
  return hn::Div(nearest2, s);
#endif
}

// (rows - center) * scale for the lanes from `rows` on, differences in double.
HWY_INLINE V places_from(const double* rows, double center, double scale) {
  const D d;
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(d, static_cast<float>((*rows - center) * scale));
#else
  const hn::Repartition<double, D> dd;
  const hn::Rebind<float, decltype(dd)> half;
  const auto c = hn::Set(dd, center), f = hn::Set(dd, scale);
  const auto low = hn::Mul(hn::Sub(hn::LoadU(dd, rows), c), f);
  const auto high = hn::Mul(hn::Sub(hn::LoadU(dd, rows + hn::Lanes(dd)), c), f);
  return hn::Combine(d, hn::DemoteTo(half, high), hn::DemoteTo(half, low));
#endif
}

HWY_INLINE void add_lanes(const V& v, double scale, double* to) {
#if HWY_TARGET == HWY_SCALAR
  *to += scale * static_cast<double>(hn::GetLane(v));
#else
  const hn::Repartition<double, D> dd;
  const hn::Rebind<float, decltype(dd)> half;
  const auto f = hn::Set(dd, scale);
  double* const high = to + hn::Lanes(dd);
  hn::StoreU(hn::MulAdd(f, hn::PromoteTo(dd, hn::LowerHalf(half, v)), hn::LoadU(dd, to)), dd, to);
  hn::StoreU(hn::MulAdd(f, hn::PromoteTo(dd, hn::UpperHalf(half, v)), hn::LoadU(dd, high)), dd,
             high);
#endif
}

// A pole of depth a: value / a, z dg/dz / a, and exp(-x) / rho, for rho^2 = s.
struct PoleVectors {
  V value, z_d_z, decay;
};

// a2_3: 3 a^2. kappa: times log2(e).
HWY_INLINE PoleVectors pole_vectors(V s, V kappa, V a2_3, V a2_kappa2) {
  const V q = inverse_root(s);
  const V t = hn::Mul(kappa, hn::Mul(s, q));
  const V e = exp2_of_minus(t);
  const V q2 = hn::Mul(q, q);
  const V g = hn::Mul(e, q);
  const V h = hn::Mul(g, q2);
  const V one_x = hn::MulAdd(set(std::numbers::ln2_v<float>), t, set(1.0F));
  const V value = hn::Mul(one_x, h);
  const V bend = hn::NegMulAdd(a2_3, q2, set(1.0F));
  return {value, hn::MulSub(value, bend, hn::Mul(a2_kappa2, h)), g};
}

void add_point_sums_here(const KernelDipole* media, std::size_t n_media, const RowLanes& rows,
                         const KernelPoints* points, std::size_t n_points, double unit,
                         LaneSums* sums) {
  const D d;
  for (std::size_t m = 0; m < n_media; ++m) {
    // Lengths in units of z_r, so that floats neither overflow nor vanish.
    const double per_length = 1.0 / media[m].z_r_mm;
    const double per_area = per_length * per_length;
    const double depth = media[m].z_v_mm * per_length;
    const double kappa_unit = media[m].kappa_per_mm * media[m].z_r_mm;
    const V scale = set(per_area), one = set(1.0F);
    const V kappa = set(kappa_unit * std::numbers::log2e);
    const V three = set(3.0F), kappa2 = set(kappa_unit * kappa_unit);
    const V a = set(depth), a2 = set(depth * depth), a2_3 = set(3.0 * depth * depth);
    const V a2_kappa2 = set(depth * depth * kappa_unit * kappa_unit);
    for (std::size_t i = 0; i < kRowLanes; i += hn::Lanes(d)) {
      for (const KernelPoints* k = points; k != points + n_points; ++k) {
        const V x = places_from(rows.x + i, k->center_mm[0], 1.0);
        const V y = places_from(rows.y + i, k->center_mm[1], 1.0);
        const V z = places_from(rows.z + i, k->center_mm[2], 1.0);
        if (k + 1 != points + n_points) {
          for (const float* p : {k[1].x_mm, k[1].y_mm, k[1].z_mm, k[1].weight}) {
            hwy::Prefetch(p);
            hwy::Prefetch(p + 16);
          }
        }
        V value = hn::Zero(d), z_d_z = hn::Zero(d), decay = hn::Zero(d);
        for (std::size_t j = 0; j < k->count; ++j) {
          const V dx = hn::Sub(x, set(k->x_mm[j]));
          const V dy = hn::Sub(y, set(k->y_mm[j]));
          const V dz = hn::Sub(z, set(k->z_mm[j]));
          const V d2 = hn::Mul(scale, hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz))));
          const PoleVectors r = pole_vectors(hn::Add(d2, one), kappa, three, kappa2);
          const PoleVectors v = pole_vectors(hn::Add(d2, a2), kappa, a2_3, a2_kappa2);
          const V c = set(k->weight[j]);
          value = hn::MulAdd(c, hn::MulAdd(a, v.value, r.value), value);
          z_d_z = hn::MulAdd(c, hn::MulAdd(a, v.z_d_z, r.z_d_z), z_d_z);
          decay = hn::MulAdd(c, hn::MulAdd(a, v.decay, r.decay), decay);
        }
        add_lanes(value, unit * per_area, sums[m].value + i);
        add_lanes(z_d_z, unit * per_area, sums[m].z_d_z + i);
        add_lanes(decay, unit, sums[m].decay + i);
      }
    }
  }
}

// rows in the cluster's frame and units.
HWY_INLINE void turn(const float* f, V& x, V& y, V& z) {
  const V a = hn::MulAdd(set(f[0]), x, hn::MulAdd(set(f[1]), y, hn::Mul(set(f[2]), z)));
  const V b = hn::MulAdd(set(f[3]), x, hn::MulAdd(set(f[4]), y, hn::Mul(set(f[5]), z)));
  z = hn::MulAdd(set(f[6]), x, hn::MulAdd(set(f[7]), y, hn::Mul(set(f[8]), z)));
  x = a;
  y = b;
}

// The monomials of degree k from those of degree k - 1.
template <bool kPlanar>
HWY_INLINE void raise(int k, V x, V y, V z, const V* from, V* to) {
  const auto lower = monomials_of_degree(k - 1, kPlanar);
  if constexpr (kPlanar) {
    for (std::size_t i = 0; i < lower; ++i) to[i] = hn::Mul(x, from[i]);
    to[lower] = hn::Mul(y, from[lower - 1]);
  } else {
    std::size_t at = 0, below = 0;
    for (int l = 0; l < k; ++l) {
      for (int j = 0; j < k - l; ++j) to[at++] = hn::Mul(x, from[below++]);
      to[at++] = hn::Mul(y, from[below - 1]);
    }
    to[at] = hn::Mul(z, from[lower - 1]);
  }
}

// Adds to term[q] what the monomials of degree k in r give.
template <int k, int kDegree, bool kPlanar>
HWY_INLINE void add_terms(V x, V y, V z, const V* below, const float* coefficients, V* term) {
  if constexpr (k <= kDegree) {
    V mono[monomials_of_degree(k, kPlanar)];
    raise<kPlanar>(k, x, y, z, below, mono);
    constexpr int kTop = (kDegree - k) / 2;
    constexpr std::size_t kFrom[] = {
        coefficient_place(k, 0, kPlanar), coefficient_place(k + 2, 1, kPlanar),
        coefficient_place(k + 4, 2, kPlanar), coefficient_place(k + 6, 3, kPlanar)};
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
    V x = places_from(rows.x + i, c.center_mm[0], per_radius);
    V y = places_from(rows.y + i, c.center_mm[1], per_radius);
    V z = places_from(rows.z + i, c.center_mm[2], per_radius);
    const V r2 = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
    V term[kTerms];
    term[0] = set(c.coefficients[0]);
    if constexpr (kDegree > 1) {
      turn(c.frame, x, y, z);
      for (int q = 1; q < kTerms; ++q) term[q] = hn::Zero(d);
      // Powers of |D|^2 alone.
      for (int m = 1; 2 * m <= kDegree; ++m) {
        term[m] = set(c.coefficients[coefficient_place(2 * m, m, kPlanar)]);
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
    // Frame and coefficients come from far away.
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
      const V x = places_from(rows.x + i, rest->center_mm[0], per_length);
      const V y = places_from(rows.y + i, rest->center_mm[1], per_length);
      const V z = places_from(rows.z + i, rest->center_mm[2], per_length);
      const V pole2 = set(pole * pole * per_length * per_length);
      const V s = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::MulAdd(z, z, pole2)));
      // Raised to 1e-6: its powers are told from 0.
      const V w = hn::Max(quotient(set(1.0F), s), set(1e-6F));
      V product = w;
      for (int k = 1; k < rest->power; ++k) product = hn::Mul(product, w);
      add_lanes(product, 1.003 * rest->largest, lanes + i);
    }
  }
}

template <int k, bool kPlanar>
HWY_INLINE void add_monomials(V x, V y, V z, const V* below, int degree, V* raw) {
  if constexpr (k <= kLargestDegree) {
    if (k > degree) return;
    V mono[monomials_of_degree(k, kPlanar)];
    raise<kPlanar>(k, x, y, z, below, mono);
    for (std::size_t i = 0; i < monomials_of_degree(k, kPlanar); ++i) {
      raw[i] = hn::Add(raw[i], mono[i]);
    }
    add_monomials<k + 1, kPlanar>(x, y, z, mono, degree, raw + monomials_of_degree(k, kPlanar));
  }
}

template <bool kPlanar>
void moments_of(const double* xs, const double* ys, const double* zs, const float* ws,
                std::size_t n_points, const double* center, double scale, const float* frame,
                int degree, KernelMoments& out) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  V raw[165];
  std::size_t count = 0;
  for (int k = 0; k <= degree; ++k) count += monomials_of_degree(k, kPlanar);
  for (std::size_t i = 0; i < count; ++i) raw[i] = hn::Zero(d);
  V absolute[5] = {hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  for (std::size_t first = 0; first < n_points; first += lanes) {
    HWY_ALIGN float px[kRowLanes] = {}, py[kRowLanes] = {}, pz[kRowLanes] = {}, pw[kRowLanes] = {};
    const std::size_t n = n_points - first < lanes ? n_points - first : lanes;
    for (std::size_t i = 0; i < n; ++i) {
      px[i] = static_cast<float>((xs[first + i] - center[0]) * scale);
      py[i] = static_cast<float>((ys[first + i] - center[1]) * scale);
      pz[i] = static_cast<float>((zs[first + i] - center[2]) * scale);
      pw[i] = ws[first + i];
    }
    V x = hn::Load(d, px), y = hn::Load(d, py), z = hn::Load(d, pz);
    const V w = hn::Load(d, pw);
    const V r2 = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
    const V r = hn::Sqrt(r2);
    const V w2 = hn::Mul(w, r2), w3 = hn::Mul(w2, r), r4 = hn::Mul(r2, r2);
    absolute[0] = hn::Add(absolute[0], w2);
    absolute[1] = hn::Add(absolute[1], w3);
    absolute[2] = hn::MulAdd(w3, r2, absolute[2]);
    absolute[3] = hn::MulAdd(w3, r4, absolute[3]);
    absolute[4] = hn::MulAdd(hn::Mul(w3, r4), r2, absolute[4]);
    turn(frame, x, y, z);
    raw[0] = hn::Add(raw[0], w);
    add_monomials<1, kPlanar>(x, y, z, &w, degree, raw + 1);
  }
  for (std::size_t i = 0; i < count; ++i) out.raw[i] = hn::GetLane(hn::SumOfLanes(d, raw[i]));
  for (int i = 0; i < 5; ++i) out.absolute[i] = hn::GetLane(hn::SumOfLanes(d, absolute[i]));
}

void sum_moments_here(const double* x, const double* y, const double* z, const float* w,
                      std::size_t count, const double* center, double scale, const float* frame,
                      bool planar, int degree, KernelMoments& out) {
  if (planar) {
    moments_of<true>(x, y, z, w, count, center, scale, frame, degree, out);
  } else {
    moments_of<false>(x, y, z, w, count, center, scale, frame, degree, out);
  }
}

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace scattermeter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scattermeter {
HWY_EXPORT(add_point_sums_here);
HWY_EXPORT(add_cluster_sums_here);
HWY_EXPORT(add_lane_rests_here);
HWY_EXPORT(sum_moments_here);
HWY_EXPORT(target_name);

namespace {

// Asked for once: it is slow, and until then every call would ask.
void choose_target() {
  static const bool chosen = [] {
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return true;
  }();
  static_cast<void>(chosen);
}

}  // namespace

const char* kernel_instruction_set() {
  choose_target();
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

bool choose_kernel_instruction_set(const char* name) {
  choose_target();
  hwy::SetSupportedTargetsForTest(0);
  const std::int64_t all = hwy::SupportedTargets();
  std::int64_t wanted = all;
  if (*name != '\0') {
    wanted = 0;
    // Better sets have lower bits.
    for (std::int64_t bit = 1; bit < HWY_SCALAR; bit <<= 1) {
      if ((all & HWY_TARGETS & bit) != 0 && std::strcmp(hwy::TargetName(bit), name) == 0) {
        wanted = all & ~(bit - 1);
      }
    }
    if (wanted == 0) return false;
    hwy::SetSupportedTargetsForTest(wanted);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  return true;
}

void add_point_sums(std::span<const KernelDipole> media, const RowLanes& rows,
                    std::span<const KernelPoints> points, double unit, std::span<LaneSums> sums) {
  choose_target();
  HWY_DYNAMIC_DISPATCH(add_point_sums_here)
  (media.data(), media.size(), rows, points.data(), points.size(), unit, sums.data());
}

void add_cluster_sums(std::span<const KernelDipole> media, const RowLanes& rows,
                      std::span<const KernelSeries> series, std::span<LaneSums> sums) {
  choose_target();
  HWY_DYNAMIC_DISPATCH(add_cluster_sums_here)
  (media.data(), media.size(), rows, series.data(), series.size(), sums.data());
}

void add_lane_rests(const RowLanes& rows, std::span<const LaneRest> rests, double pole_mm,
                    double* lanes) {
  choose_target();
  HWY_DYNAMIC_DISPATCH(add_lane_rests_here)
  (rows, rests.data(), rests.size(), pole_mm, lanes);
}

void sum_moments(const double* x_mm, const double* y_mm, const double* z_mm, const float* weight,
                 std::size_t count, const double* center_mm, double radius_mm, const float* frame,
                 bool planar, int degree, KernelMoments& out) {
  choose_target();
  HWY_DYNAMIC_DISPATCH(sum_moments_here)
  (x_mm, y_mm, z_mm, weight, count, center_mm, 1.0 / radius_mm, frame, planar, degree, out);
}

}  // namespace scattermeter
#endif  // HWY_ONCE
