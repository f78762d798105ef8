#include "core/sums/pair_kernels.h"

#include "core/sums/dipole_kernels.h"

// The file is compiled once for each instruction set (core/sums/CMakeLists.txt).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/sums/pair_kernels.cc"
#include <hwy/foreach_target.h>
// This comes after it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace scattermeter::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Products and sums are rounded one by one, also where they could be fused
// (core/sums/CMakeLists.txt).
template <class V>
HWY_INLINE V squares(V x, V y, V z) {
  return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}

template <int kPoints, int kLanes>
HWY_INLINE void point_pairs(const PlacedPoints<kLanes>* sets, int n, const float* even, float* d2,
                            float* power) {
  const hn::CappedTag<float, kLanes> d;
  for (int k = 0; k < n; ++k) {
    const PlacedPoints<kLanes>& set = sets[k];
    const auto scale = hn::Set(d, set.scale);
    const auto along = [&](float at, const float* from) {
      return hn::Add(hn::Set(d, at), hn::Mul(scale, hn::LoadU(d, from)));
    };
    for (std::size_t i = 0; i < kLanes; i += hn::Lanes(d)) {
      const auto x = along(set.x, set.points->x + i);
      const auto y = along(set.y, set.points->y + i);
      const auto z = along(set.z, set.points->z + i);
      hn::StoreU(squares(x, y, z), d, d2 + i);
      auto own = hn::Mul(hn::Set(d, set.of_power), hn::LoadU(d, set.points->power + i));
      if (even != nullptr) {
        own = hn::Add(own, hn::Mul(hn::Set(d, set.even), hn::LoadU(d, even + i)));
      }
      hn::StoreU(own, d, power + i);
    }
    d2 += kPoints;
    power += kPoints;
  }
}

void three_point_pairs_here(const PlacedPoints<4>* sets, int n, float* d2, float* power) {
  point_pairs<3>(sets, n, nullptr, d2, power);
}

void six_point_pairs_here(const PlacedPoints<8>* sets, int n, const float* even, float* d2,
                          float* power) {
  point_pairs<6>(sets, n, even, d2, power);
}

// The difference of two independent points has the sum of their covariances C = L L^T. The four
// points d + L v, v the corners of a cube of even parity, have mean d and covariance C.
void cluster_pairs_here(const ClusterBatch& c, const float* site, float* d2, float* power) {
  const hn::CappedTag<float, ClusterBatch::kSize> d;
  using V = hn::Vec<decltype(d)>;
  const V none = hn::Zero(d);
  for (std::size_t i = 0; i < ClusterBatch::kSize; i += hn::Lanes(d)) {
    const auto sum = [&](const float* of, int at) {
      return hn::Add(hn::LoadU(d, of + i), hn::Set(d, site[at]));
    };
    // In a plane that is nearly perpendicular to an axis only rounding is left along it, and a
    // quotient of rounding errors may be of any size: a pivot below 1e-6 of the whole counts as
    // zero, and so does what is divided by its root.
    const V c11 = sum(c.xx, 0), c22 = sum(c.yy, 3), c33 = sum(c.zz, 5);
    const V least = hn::Mul(hn::Set(d, 1e-6F), hn::Add(hn::Add(c11, c22), c33));
    const auto is_first = hn::Gt(c11, least);
    const V l11 = hn::IfThenElse(is_first, hn::Sqrt(c11), none);
    const V l21 = hn::IfThenElse(is_first, hn::Div(sum(c.xy, 1), l11), none);
    const V l31 = hn::IfThenElse(is_first, hn::Div(sum(c.xz, 2), l11), none);
    const V r22 = hn::Sub(c22, hn::Mul(l21, l21));
    const auto is_second = hn::Gt(r22, least);
    const V l22 = hn::IfThenElse(is_second, hn::Sqrt(r22), none);
    const V l32 =
        hn::IfThenElse(is_second, hn::Div(hn::Sub(sum(c.yz, 4), hn::Mul(l21, l31)), l22), none);
    const V r33 = hn::Sub(hn::Sub(c33, hn::Mul(l31, l31)), hn::Mul(l32, l32));
    const V l33 = hn::IfThenElse(hn::Gt(r33, least), hn::Sqrt(r33), none);
    const V x = hn::LoadU(d, c.x + i), y = hn::LoadU(d, c.y + i), z = hn::LoadU(d, c.z + i);
    const V quarter = hn::Mul(hn::Set(d, 0.25F), hn::LoadU(d, c.power + i));
    constexpr bool kMinus[4][3] = {
        {false, false, false}, {false, true, true}, {true, false, true}, {true, true, false}};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto by = [&](V a, V step, std::size_t axis) {
        return kMinus[k][axis] ? hn::Sub(a, step) : hn::Add(a, step);
      };
      const V px = by(x, l11, 0);
      const V py = by(by(y, l21, 0), l22, 1);
      const V pz = by(by(by(z, l31, 0), l32, 1), l33, 2);
      const std::size_t at = k * ClusterBatch::kSize + i;
      hn::StoreU(squares(px, py, pz), d, d2 + at);
      hn::StoreU(quarter, d, power + at);
    }
  }
}

void add_octave_pairs_here(const OctaveScale& scale, const float* d2, const float* power, int n,
                           float* sums) {
  const hn::CappedTag<float, 16> d;
  const hn::RebindToSigned<decltype(d)> di;
  const std::size_t lanes = hn::Lanes(d);
  const std::int32_t step = std::int32_t{1} << scale.shift;
  const auto s0 = hn::Set(d, scale.s0), fraction = hn::Set(d, 1.0F / static_cast<float>(step));
  const auto first = hn::Set(di, scale.first), last = hn::Set(di, scale.last_bin);
  const auto rest = hn::Set(di, step - 1);
  const auto count = static_cast<std::size_t>(n);
  for (std::size_t k = 0; k < count; k += lanes) {
    HWY_ALIGN std::int32_t at[16];
    HWY_ALIGN float shares[32];
    const auto s = hn::BitCast(di, hn::Add(hn::LoadU(d, d2 + k), s0));
    hn::Store(hn::Min(hn::Sub(hn::ShiftRightSame(s, scale.shift), first), last), di, at);
    const auto w = hn::LoadU(d, power + k);
    const auto next = hn::Mul(w, hn::Mul(hn::ConvertTo(d, hn::And(s, rest)), fraction));
    hn::StoreInterleaved2(hn::Sub(w, next), next, d, shares);
    const std::size_t here = count - k < lanes ? count - k : lanes;
    for (std::size_t i = 0; i < here; ++i) {
      float* const sum = sums + 2 * at[i];
      sum[0] += shares[2 * i];
      sum[1] += shares[2 * i + 1];
    }
  }
}

}  // namespace scattermeter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scattermeter {
HWY_EXPORT(three_point_pairs_here);
HWY_EXPORT(six_point_pairs_here);
HWY_EXPORT(cluster_pairs_here);
HWY_EXPORT(add_octave_pairs_here);

void three_point_pairs(const PlacedPoints<4>* sets, int n, float* d2, float* power) {
  prepare_kernels();
  HWY_DYNAMIC_DISPATCH(three_point_pairs_here)(sets, n, d2, power);
}

void six_point_pairs(const PlacedPoints<8>* sets, int n, const float* even, float* d2,
                     float* power) {
  prepare_kernels();
  HWY_DYNAMIC_DISPATCH(six_point_pairs_here)(sets, n, even, d2, power);
}

void cluster_pairs(const ClusterBatch& clusters, const float* site, float* d2, float* power) {
  prepare_kernels();
  HWY_DYNAMIC_DISPATCH(cluster_pairs_here)(clusters, site, d2, power);
}

void add_octave_pairs(const OctaveScale& scale, const float* d2, const float* power, int n,
                      float* sums) {
  prepare_kernels();
  HWY_DYNAMIC_DISPATCH(add_octave_pairs_here)(scale, d2, power, n, sums);
}

}  // namespace scattermeter
#endif  // HWY_ONCE
