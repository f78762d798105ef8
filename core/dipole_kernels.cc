#include "core/dipole_kernels.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

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

struct Places {
  HWY_ALIGN float x[kRowLanes], y[kRowLanes], z[kRowLanes];
};

// (rows - center) * scale, differences in double.
HWY_INLINE void places_from(const RowLanes& rows, const double* center, double scale, Places& out) {
  const double cx = center[0], cy = center[1], cz = center[2];
  for (std::size_t i = 0; i < kRowLanes; ++i) {
    out.x[i] = static_cast<float>((rows.x[i] - cx) * scale);
    out.y[i] = static_cast<float>((rows.y[i] - cy) * scale);
    out.z[i] = static_cast<float>((rows.z[i] - cz) * scale);
  }
}

HWY_INLINE void add_lanes(const V& v, double scale, double* to) {
  HWY_ALIGN float lane[kRowLanes];
  hn::Store(v, D(), lane);
  for (std::size_t i = 0; i < hn::Lanes(D()); ++i) to[i] += scale * static_cast<double>(lane[i]);
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
                         const KernelPoints& k, double unit, LaneSums* sums) {
  const D d;
  Places p;
  places_from(rows, k.center_mm, 1.0, p);
  for (std::size_t m = 0; m < n_media; ++m) {
    // Lengths in units of z_r, so that floats neither overflow nor vanish.
    const double per_area = 1.0 / (media[m].z_r_mm * media[m].z_r_mm);
    const double depth = media[m].z_v_mm / media[m].z_r_mm;
    const double kappa_unit = media[m].kappa_per_mm * media[m].z_r_mm;
    const V scale = set(per_area), one = set(1.0F);
    const V kappa = set(kappa_unit * std::numbers::log2e);
    const V three = set(3.0F), kappa2 = set(kappa_unit * kappa_unit);
    const V a = set(depth), a2 = set(depth * depth), a2_3 = set(3.0 * depth * depth);
    const V a2_kappa2 = set(depth * depth * kappa_unit * kappa_unit);
    for (std::size_t i = 0; i < kRowLanes; i += hn::Lanes(d)) {
      const V x = hn::Load(d, p.x + i), y = hn::Load(d, p.y + i), z = hn::Load(d, p.z + i);
      V value = hn::Zero(d), z_d_z = hn::Zero(d), decay = hn::Zero(d);
      for (std::size_t j = 0; j < k.count; ++j) {
        const V dx = hn::Sub(x, set(k.x_mm[j]));
        const V dy = hn::Sub(y, set(k.y_mm[j]));
        const V dz = hn::Sub(z, set(k.z_mm[j]));
        const V d2 = hn::Mul(scale, hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz))));
        const PoleVectors r = pole_vectors(hn::Add(d2, one), kappa, three, kappa2);
        const PoleVectors v = pole_vectors(hn::Add(d2, a2), kappa, a2_3, a2_kappa2);
        const V c = set(k.weight[j]);
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

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace scattermeter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scattermeter {
HWY_EXPORT(add_point_sums_here);
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
                    const KernelPoints& points, double unit, std::span<LaneSums> sums) {
  choose_target();
  HWY_DYNAMIC_DISPATCH(add_point_sums_here)
  (media.data(), media.size(), rows, points, unit, sums.data());
}

}  // namespace scattermeter
#endif  // HWY_ONCE
