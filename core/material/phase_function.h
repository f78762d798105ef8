// Phase functions: how a scattering turns the direction of flight.
#pragma once

#include <array>

#include <Eigen/Core>

#include "core/base/random_stream.h"
#include "core/material/henyey_greenstein.h"

namespace scattermeter {

// Axially symmetric; a mixture of at most two lobes. With g_n its n-th Legendre moment, g_1 is the
// mean cosine, and gamma = (1 - g_2) / (1 - g_1) is what light near its entry tells beyond
// sigma_s' = sigma_s (1 - g_1) (Bevilacqua & Depeursinge 1999, eq. 9): 1 for isotropic scattering,
// 1 + g for Henyey and Greenstein's function.
class PhaseFunction {
 public:
  // Henyey and Greenstein's, -1 < g < 1.
  PhaseFunction(double g = 0.0) : PhaseFunction(1.0, g, Other::kHenyeyGreenstein, 0.0) {}
  // Two functions of Henyey and Greenstein, the first with a probability of `share`, 0 .. 1.
  static PhaseFunction mixture(double share, double g, double other_g) {
    return {share, g, Other::kHenyeyGreenstein, other_g};
  }
  // Of mean cosine g and this gamma: a function of Henyey and Greenstein, and 3/(4 pi) cos^2 (same
  // paper, eq. 17). Domain: 0 < g < 1, 0.6 < gamma <= 1 + g (std::invalid_argument).
  static PhaseFunction with_gamma(double g, double gamma);

  bool is_isotropic() const { return share_ == 1.0 && g_ == 0.0; }
  double mean_cosine() const { return share_ * g_ + (1.0 - share_) * other_moment(1); }
  double gamma() const { return (1.0 - second_moment()) / (1.0 - mean_cosine()); }
  // Throws std::invalid_argument outside the domain.
  void check() const;
  // Equal numbers, equal functions.
  std::array<double, 4> numbers() const {
    return {share_, g_, static_cast<double>(other_), other_g_};
  }
  bool operator==(const PhaseFunction& b) const { return numbers() == b.numbers(); }

  // 1/sr; cos: cosine between the directions of flight before and after scattering.
  double per_sr(double cos_angle) const {
    if (share_ == 1.0) return HenyeyGreenstein(g_).per_sr(cos_angle);
    return share_ * HenyeyGreenstein(g_).per_sr(cos_angle) +
           (1.0 - share_) * other_per_sr(cos_angle);
  }
  // A direction after scattering; unit length to rounding.
  Eigen::Vector3d sample(const Eigen::Vector3d& before, RandomStream& random) const {
    if (share_ == 1.0 || (share_ > 0.0 && random.uniform() < share_)) {
      return HenyeyGreenstein(g_).sample(before, random);
    }
    return sample_other(before, random);
  }

 private:
  enum class Other { kHenyeyGreenstein, kSquaredCosine };
  PhaseFunction(double share, double g, Other other, double other_g)
      : share_(share), g_(g), other_(other), other_g_(other_g) {}
  double second_moment() const { return share_ * g_ * g_ + (1.0 - share_) * other_moment(2); }
  // 1 or 2, of the other lobe.
  double other_moment(int order) const;
  double other_per_sr(double cos_angle) const;
  Eigen::Vector3d sample_other(const Eigen::Vector3d& before, RandomStream& random) const;

  double share_, g_;
  Other other_;
  double other_g_;
};

}  // namespace scattermeter
