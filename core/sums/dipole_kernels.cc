#include "core/sums/dipole_kernels.h"

#include <cstdint>
#include <cstring>
#include <numbers>

#include <hwy/cache_control.h>

// The file is compiled once for each instruction set (core/sums/CMakeLists.txt).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/sums/dipole_kernels.cc"
#include <hwy/foreach_target.h>
// This comes after it.
#include <hwy/highway.h>

#include "core/sums/kernel_vectors.inc"

HWY_BEFORE_NAMESPACE();
namespace scattermeter::HWY_NAMESPACE {

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
        const V x = offsets_from(rows.x + i, k->center_mm[0], 1.0);
        const V y = offsets_from(rows.y + i, k->center_mm[1], 1.0);
        const V z = offsets_from(rows.z + i, k->center_mm[2], 1.0);
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

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace scattermeter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scattermeter {
HWY_EXPORT(add_point_sums_here);
HWY_EXPORT(target_name);

void prepare_kernels() {
  // Asked for once: it is slow, and until then every call would ask.
  static const bool chosen = [] {
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return true;
  }();
  static_cast<void>(chosen);
}

const char* kernel_instruction_set() {
  prepare_kernels();
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

bool choose_kernel_instruction_set(const char* name) {
  prepare_kernels();
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
  prepare_kernels();
  HWY_DYNAMIC_DISPATCH(add_point_sums_here)
  (media.data(), media.size(), rows, points.data(), points.size(), unit, sums.data());
}

}  // namespace scattermeter
#endif  // HWY_ONCE
