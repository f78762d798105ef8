#include "core/sums/moment_kernels.h"

#include <cstddef>

// The file is compiled once for each instruction set (core/sums/CMakeLists.txt).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/sums/moment_kernels.cc"
#include <hwy/foreach_target.h>
// This comes after it.
#include <hwy/highway.h>

#include "core/sums/kernel_vectors.inc"
// And this after that.
#include "core/sums/monomials.inc"

HWY_BEFORE_NAMESPACE();
namespace scattermeter::HWY_NAMESPACE {

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

}  // namespace scattermeter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scattermeter {
HWY_EXPORT(sum_moments_here);

void sum_moments(const double* x_mm, const double* y_mm, const double* z_mm, const float* weight,
                 std::size_t count, const double* center_mm, double radius_mm, const float* frame,
                 bool planar, int degree, KernelMoments& out) {
  prepare_kernels();
  HWY_DYNAMIC_DISPATCH(sum_moments_here)
  (x_mm, y_mm, z_mm, weight, count, center_mm, 1.0 / radius_mm, frame, planar, degree, out);
}

}  // namespace scattermeter
#endif  // HWY_ONCE
