#include "core/material/half_space_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace scattermeter {
namespace {

constexpr int kNodes = 64;

struct CosineRule {
  std::array<double, kNodes> mu{}, weight{};
};

// Gauss and Legendre's rule in u over 0 .. 1 with mu = u^2: H has mu ln(mu) in it, which is smooth
// enough in u.
CosineRule make_rule() {
  CosineRule rule;
  for (int i = 0; i < kNodes; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (kNodes + 0.5));
    double slope = 1.0;
    for (int newton = 0; newton < 8; ++newton) {
      double p = x, before = 1.0;
      for (int n = 2; n <= kNodes; ++n) {
        const double next = ((2 * n - 1) * x * p - (n - 1) * before) / n;
        before = p;
        p = next;
      }
      slope = kNodes * (x * p - before) / (x * x - 1.0);
      x -= p / slope;
    }
    const double u = 0.5 * (1.0 + x);
    const auto k = static_cast<std::size_t>(i);
    rule.mu[k] = u * u;
    rule.weight[k] = 2.0 * u / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

// 1 / H(mu) = sqrt(1 - albedo) + albedo / 2 integral of mu' H(mu') / (mu + mu') dmu' (Chandrasekhar
// chapter V, eq. 7 and 15), at the rule's nodes. The geometric mean of two steps converges also
// where the albedo is 1.
class HFunction {
 public:
  explicit HFunction(double albedo) : albedo_(albedo), root_(std::sqrt(1.0 - albedo)) {
    h_.fill(1.0);
    for (int step = 0; step < 200; ++step) {
      double change = 0.0;
      std::array<double, kNodes> next{};
      for (std::size_t i = 0; i < kNodes; ++i) {
        next[i] = std::sqrt(h_[i] * at(rule().mu[i]));
        change = std::max(change, std::abs(next[i] / h_[i] - 1.0));
      }
      h_ = next;
      if (change < 1e-14) break;
    }
  }

  double at(double mu) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < kNodes; ++i) {
      sum += rule().weight[i] * rule().mu[i] * h_[i] / (mu + rule().mu[i]);
    }
    return 1.0 / (root_ + 0.5 * albedo_ * sum);
  }

  double first_moment() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < kNodes; ++i) sum += rule().weight[i] * rule().mu[i] * h_[i];
    return sum;
  }

  double root() const { return root_; }

 private:
  static const CosineRule& rule() {
    static const CosineRule kRule = make_rule();
    return kRule;
  }
  double albedo_, root_;
  std::array<double, kNodes> h_{};
};

void require(bool holds, double albedo, double cosine) {
  if (holds) return;
  throw std::invalid_argument("half_space_albedo: albedo = " + std::to_string(albedo) +
                              ", cosine = " + std::to_string(cosine));
}

}  // namespace

double half_space_albedo(double single_scattering_albedo) {
  require(single_scattering_albedo >= 0.0 && single_scattering_albedo <= 1.0,
          single_scattering_albedo, 1.0);
  const HFunction h(single_scattering_albedo);
  return 1.0 - 2.0 * h.root() * h.first_moment();
}

double half_space_albedo(double single_scattering_albedo, double cos_incidence) {
  require(single_scattering_albedo >= 0.0 && single_scattering_albedo <= 1.0 &&
              cos_incidence > 0.0 && cos_incidence <= 1.0,
          single_scattering_albedo, cos_incidence);
  const HFunction h(single_scattering_albedo);
  return 1.0 - h.root() * h.at(cos_incidence);
}

}  // namespace scattermeter
