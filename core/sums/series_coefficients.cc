#include "core/sums/series_coefficients.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace scattermeter {
namespace {

// The way from raw moments to coefficients: those of |D|^2m are sums of moments of |D|^2(m-1), two
// degrees higher.
template <bool kPlanar>
struct CoefficientPlan {
  struct Step {
    std::uint16_t to, from[3];  // planar: two of them
  };
  static constexpr std::size_t kCount = coefficient_index(kLargestDegree + 1, 0, kPlanar);
  std::array<std::uint16_t, kCount> raw{};  // of m = 0: index of the moment
  std::array<Step, kCount> steps{};         // of m >= 1, by falling degree within each m
  std::array<float, kCount> factor{};       // (-1/2)^m / (m! i! j! l!)
  std::array<std::size_t, kLargestDegree + 1> steps_of{};  // how many for a largest degree
};

template <bool kPlanar>
const CoefficientPlan<kPlanar>& coefficient_plan() {
  static const CoefficientPlan<kPlanar> kPlan = [] {
    constexpr double kInverseFactorial[] = {1.0,       1.0,       1.0 / 2,    1.0 / 6,    1.0 / 24,
                                            1.0 / 120, 1.0 / 720, 1.0 / 5040, 1.0 / 40320};
    // Index of x^(k-l-j) y^j z^l among those of degree k.
    const auto index = [](int k, int l, int j) {
      return static_cast<std::size_t>(l * (k + 1) - l * (l - 1) / 2 + j);
    };
    CoefficientPlan<kPlanar> plan;
    std::size_t steps = 0, moments = 0;
    // A step needs those of one m less, of the same degree n.
    for (int n = 0; n <= kLargestDegree; ++n) {
      double sign = 1.0;
      for (int m = 0; 2 * m <= n; ++m) {
        const int k = n - 2 * m;
        const std::size_t base = coefficient_index(n, m, kPlanar);
        const std::size_t above = m > 0 ? coefficient_index(n, m - 1, kPlanar) : 0;
        for (int l = 0; l <= (kPlanar ? 0 : k); ++l) {
          for (int j = 0; j <= k - l; ++j) {
            const std::size_t to = base + index(k, l, j);
            plan.factor[to] = static_cast<float>(sign * kInverseFactorial[k - l - j] *
                                                 kInverseFactorial[j] * kInverseFactorial[l]);
            if (m == 0) {
              plan.raw[to] = static_cast<std::uint16_t>(moments + index(k, l, j));
            } else {
              const auto source = [&](int ll, int jj) {
                return static_cast<std::uint16_t>(above + index(k + 2, ll, jj));
              };
              plan.steps[steps++] = {
                  static_cast<std::uint16_t>(to),
                  {source(l, j), source(l, j + 2), kPlanar ? std::uint16_t{0} : source(l + 2, j)}};
            }
          }
        }
        sign *= -0.5 / (m + 1);
      }
      moments += monomials_of_degree(n, kPlanar);
      plan.steps_of[static_cast<std::size_t>(n)] = steps;
    }
    return plan;
  }();
  return kPlan;
}

template <bool kPlanar>
void coefficients_from(const KernelMoments& moments, int degree, double weight, float* out) {
  const auto& plan = coefficient_plan<kPlanar>();
  const std::size_t count = coefficient_index(degree + 1, 0, kPlanar);
  const auto scale = static_cast<float>(1.0 / weight);
  for (int n = 0; n <= degree; ++n) {
    const std::size_t base = coefficient_index(n, 0, kPlanar);
    for (std::size_t i = base; i < base + monomials_of_degree(n, kPlanar); ++i) {
      out[i] = scale * moments.raw[plan.raw[i]];
    }
  }
  for (std::size_t i = 0; i < plan.steps_of[static_cast<std::size_t>(degree)]; ++i) {
    const auto& step = plan.steps[i];
    out[step.to] = out[step.from[0]] + out[step.from[1]] + (kPlanar ? 0.0F : out[step.from[2]]);
  }
  for (std::size_t i = 0; i < count; ++i) out[i] *= plan.factor[i];
}

}  // namespace

void series_coefficients(const KernelMoments& moments, bool planar, int degree, double weight,
                         float* out) {
  if (planar) {
    coefficients_from<true>(moments, degree, weight, out);
  } else {
    coefficients_from<false>(moments, degree, weight, out);
  }
}

}  // namespace scattermeter
