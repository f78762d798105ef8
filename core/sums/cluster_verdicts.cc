#include "core/sums/cluster_verdicts.h"

#include <algorithm>

#include "core/sums/dipole_kernels.h"
#include "core/sums/kernel_bounds.h"

// The file is compiled once for each instruction set (core/sums/CMakeLists.txt).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/sums/cluster_verdicts.cc"
#include <hwy/foreach_target.h>
// This comes after it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace scattermeter::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, 16>;
using I = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<I>;

constexpr int kStride = sizeof(ClusterTraits) / sizeof(float);
constexpr int kCells = static_cast<int>(KernelBounds::kCells);
constexpr int kReaches = static_cast<int>(KernelBounds::kReaches);
constexpr int kTails = static_cast<int>(KernelBounds::kTails);
constexpr float kDown = 1.0F - 1e-6F, kUp = 1.0F + 1e-6F;  // rounding
// Powers of the distance in units of the radius must not overflow. (Degree 1 has another unit.)
constexpr float kFarthest[] = {3e38F, 1e10F, 3e7F, 1e5F, 5.6e3F};

HWY_INLINE V set(float x) { return hn::Set(D(), x); }
HWY_INLINE VI set(int x) { return hn::Set(I(), x); }

HWY_INLINE VI cell_of(V distance, float per_unit) {
  const VI bits = hn::ShiftRight<19>(hn::BitCast(I(), hn::Mul(distance, set(per_unit))));
  return hn::Min(hn::Max(hn::Sub(bits, set(KernelBounds::kCellBits)), set(0)), set(kCells - 1));
}

// Clusters in lanes; distances of their centres from that of the region, and of the rows that are
// nearest and farthest, without and (squared) with the nearest pole.
struct ClusterLanes {
  VI at;    // where the traits are, in floats
  VI last;  // highest of the series that may be summed
  V radius, center, low, high, nearest2;
};

// Selects in the lanes of `series` the lowest degree whose rest for the typical row is at most the
// share. Sets its verdict, and its rest for the nearest row.
HWY_INLINE void select_series(const float* base, const VerdictRegion& p, const ClusterLanes& c,
                              hn::Mask<D> series, VI& verdict, V& rest) {
  const D d;
  const I di;
  const V share = set(p.share), pole2 = set(p.nearest_pole_mm * p.nearest_pole_mm);
  const V a2 = hn::Mul(c.radius, c.radius);
  const VI cell = cell_of(c.low, p.per_cell_unit);
  const VI cells = hn::Sub(cell_of(c.high, p.per_cell_unit), cell);
  constexpr auto kOctave = static_cast<int>(KernelBounds::kPerOctave);
  const VI reach = hn::IfThenElse(hn::Gt(cells, set(2 * kOctave)), set(2),
                                  hn::IfThenElse(hn::Gt(cells, set(kOctave)), set(1), set(0)));
  const VI at_reach = hn::Add(hn::Mul(reach, set(kCells)), cell);
  const V nearest_inverse = hn::Div(set(kUp), c.nearest2);
  const V u2 = hn::Mul(a2, nearest_inverse);
  const V typical = hn::Max(hn::Sub(c.center, set(p.typical * p.radius_mm)), hn::Zero(d));
  const V v = hn::Div(a2, hn::MulAdd(typical, typical, pole2));
  const VI ratio = hn::Min(hn::ConvertTo(di, hn::Mul(set(32.0F), hn::Sqrt(u2))), set(kTails - 1));
  const VI tail = hn::Add(hn::Mul(at_reach, set(kTails)), ratio);
  const V far = hn::Div(hn::Add(c.high, set(p.farthest_pole_mm)), c.radius);
  V power_u = u2, power_v = v;
  auto decided = hn::Lt(share, share);  // none
  for (int i = 0; i < 5; ++i) {
    const V factor = hn::Mul(hn::Mul(hn::GatherIndex(d, base + 4 + i, c.at),
                                     hn::GatherIndex(d, p.need + i * kReaches * kCells, at_reach)),
                             hn::GatherIndex(d, p.tail + i * kReaches * kCells * kTails, tail));
    if (i > 0) {
      power_u = hn::Mul(power_u, u2);
      power_v = hn::Mul(power_v, v);
    }
    auto good = hn::And(hn::Le(hn::Mul(factor, power_v), share), hn::Le(far, set(kFarthest[i])));
    good = hn::And(hn::And(series, good), hn::RebindMask(d, hn::Gt(c.last, set(i - 1))));
    good = hn::AndNot(decided, good);
    decided = hn::Or(decided, good);
    verdict = hn::IfThenElse(hn::RebindMask(di, good), set(i), verdict);
    rest = hn::IfThenElse(good, hn::Mul(hn::Mul(factor, power_u), set(1.0F + 2e-5F)), rest);
  }
}

void judge_clusters_here(const ClusterTraits* traits, const std::int32_t* nodes, std::size_t count,
                         const VerdictRegion& p, const Verdicts& out) {
  const D d;
  const I di;
  const float* const base = reinterpret_cast<const float*>(traits);
  const V radius = set(p.radius_mm), slack = set(p.slack_mm), share = set(p.share);
  const V pole2 = set(p.nearest_pole_mm * p.nearest_pole_mm);
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN std::int32_t rest_of[16];
  for (std::size_t k = 0; k < count; k += lanes) {
    // Lanes beyond the end repeat the last cluster.
    if (k + lanes > count) {
      for (std::size_t i = 0; i < lanes; ++i) rest_of[i] = nodes[std::min(k + i, count - 1)];
    }
    const VI at =
        hn::Mul(k + lanes > count ? hn::Load(di, rest_of) : hn::LoadU(di, nodes + k), set(kStride));
    const V x = hn::Sub(hn::GatherIndex(d, base, at), set(p.center_mm[0]));
    const V y = hn::Sub(hn::GatherIndex(d, base + 1, at), set(p.center_mm[1]));
    const V z = hn::Sub(hn::GatherIndex(d, base + 2, at), set(p.center_mm[2]));
    const V a = hn::GatherIndex(d, base + 3, at);
    const V weight = hn::GatherIndex(d, base + 9, at);
    const VI last = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(base) + 10, at);
    const V center = hn::Sqrt(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z))));
    const V low = hn::Max(
        hn::Mul(set(kDown), hn::Sub(hn::MulSub(center, set(kDown), slack), radius)), hn::Zero(d));
    const V high = hn::Mul(set(kUp), hn::Add(hn::MulAdd(center, set(kUp), slack), radius));
    const V nearest2 = hn::MulAdd(low, low, pole2);
    const V a2 = hn::Mul(a, a);
    constexpr auto kRatio = static_cast<float>(KernelBounds::kLargestRatio);
    const auto apart = hn::Lt(a2, hn::Mul(set(kRatio * kRatio * kDown), nearest2));
    // Too little light altogether.
    const V gap = hn::Mul(set(kDown), hn::Sub(low, a));
    const V light = hn::Mul(
        weight, hn::GatherIndex(d, p.all, cell_of(hn::Max(gap, hn::Zero(d)), p.per_cell_unit)));
    const auto dropped = hn::And(apart, hn::And(hn::Gt(gap, hn::Zero(d)), hn::Le(light, share)));
    auto series = hn::RebindMask(d, hn::Gt(last, set(-1)));
    series = hn::And(apart, hn::AndNot(dropped, series));
    VI verdict = hn::IfThenElse(hn::RebindMask(di, dropped), set(kVerdictDrop), set(kVerdictOpen));
    V rest = hn::Zero(d);
    if (!hn::AllFalse(d, series)) {
      select_series(base, p, {at, last, a, center, low, high, nearest2}, series, verdict, rest);
    }
    hn::StoreU(verdict, di, out.verdict + k);
    hn::StoreU(rest, d, out.rest + k);
    // Rounded down; for a dropped cluster it is the gap.
    hn::StoreU(hn::IfThenElse(dropped, gap, hn::Mul(set(kDown), hn::Sqrt(nearest2))), d,
               out.nearest_mm + k);
  }
}

}  // namespace scattermeter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scattermeter {
HWY_EXPORT(judge_clusters_here);

void judge_clusters(const ClusterTraits* traits, std::span<const std::int32_t> nodes,
                    const VerdictRegion& region, const Verdicts& out) {
  prepare_kernels();
  HWY_DYNAMIC_DISPATCH(judge_clusters_here)(traits, nodes.data(), nodes.size(), region, out);
}

}  // namespace scattermeter
#endif  // HWY_ONCE
