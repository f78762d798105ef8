// Images of a plate lit within a rectangle, to any accuracy and for any mean free path, without the
// project's own pair sums; and the fit as the instrument makes it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/dipole.h"
#include "core/dipole_curve.h"
#include "core/dipole_fit.h"
#include "core/distance_weights.h"
#include "core/linear_shot.h"
#include "core/numerics.h"
#include "tests/core/boxes.h"

namespace scattermeter::test_support {

struct Rectangle {
  double x0 = -15, x1 = 15, y0 = -15, y1 = 15;  // mm
};

// ∫ of R over the rectangle about a point of its plane. Four right-angled rectangles with a corner
// at the point; each is two triangles ∫ dphi G(near / cos phi), G(rho) = ∫_0^rho R rho' drho' in
// closed form. With tan phi = sinh v the integrand is smooth over every magnitude of near.
class LitRectangle {
 public:
  LitRectangle(const Dipole& dipole, const Rectangle& lit) : dipole_(dipole), lit_(lit) {
    const double kappa = dipole.sigma_tr_per_mm();
    albedo_ = 2.0 * dipole.total_reflectance() /
              (std::exp(-kappa * dipole.z_r_mm()) + std::exp(-kappa * dipole.z_v_mm()));
  }

  double at(const Eigen::Vector3d& p) const {
    const double x0 = lit_.x0 - p.x(), x1 = lit_.x1 - p.x();
    const double y0 = lit_.y0 - p.y(), y1 = lit_.y1 - p.y();
    return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
  }

  // Mean over a triangle: Cowper's six points, cut in four until that changes nothing.
  double mean(const std::array<Eigen::Vector3d, 3>& c, double tolerance) const {
    return refined(c, six_points(c), tolerance, 0);
  }

 private:
  double six_points(const std::array<Eigen::Vector3d, 3>& c) const {
    double sum = 0.0;
    for (const auto& [a, w] : {std::pair{0.108103018168070, 0.223381589678011},
                               std::pair{0.816847572980459, 0.109951743655322}}) {
      for (std::size_t i = 0; i < 3; ++i) {
        sum += w * at(a * c[i] + 0.5 * (1.0 - a) * (c[(i + 1) % 3] + c[(i + 2) % 3]));
      }
    }
    return sum;
  }

  double refined(const std::array<Eigen::Vector3d, 3>& c, double coarse, double tolerance,
                 int depth) const {
    const Eigen::Vector3d ab = 0.5 * (c[0] + c[1]), bc = 0.5 * (c[1] + c[2]),
                          ca = 0.5 * (c[2] + c[0]);
    const std::array<std::array<Eigen::Vector3d, 3>, 4> parts = {
        {{c[0], ab, ca}, {ab, c[1], bc}, {ca, bc, c[2]}, {ab, bc, ca}}};
    std::array<double, 4> value{};
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) sum += 0.25 * (value[i] = six_points(parts[i]));
    if (std::abs(sum - coarse) < tolerance || depth == 6) return sum;
    sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      sum += 0.25 * refined(parts[i], value[i], 2.0 * tolerance, depth + 1);
    }
    return sum;
  }

  double corner(double x, double y) const {
    const double sign = (x < 0 ? -1.0 : 1.0) * (y < 0 ? -1.0 : 1.0);
    x = std::abs(x);
    y = std::abs(y);
    if (x == 0.0 || y == 0.0) return 0.0;
    double sum = 0.0;
    for (const auto& [near, far] : {std::pair{x, y}, std::pair{y, x}}) {
      const double end = std::asinh(far / near);
      const int steps = 4 + static_cast<int>(6.0 * end);
      for (int i = 0; i < steps; ++i) {
        for (const auto& [g, w] :
             {std::pair{0.5 - 0.3872983346207417, 5.0 / 18.0}, std::pair{0.5, 8.0 / 18.0},
              std::pair{0.5 + 0.3872983346207417, 5.0 / 18.0}}) {
          const double cosh_v = std::cosh((i + g) * end / steps);
          sum += w * end / steps * inner(near * cosh_v) / cosh_v;
        }
      }
    }
    return sign * sum;
  }

  // z (exp(-kappa z) / z - exp(-kappa far) / far) for both poles, without cancellation.
  double inner(double rho) const {
    const double kappa = dipole_.sigma_tr_per_mm();
    double sum = 0.0;
    for (double z : {dipole_.z_r_mm(), dipole_.z_v_mm()}) {
      const double far = std::sqrt(rho * rho + z * z);
      const double more = rho * rho / (far + z);  // far - z
      sum += std::exp(-kappa * z) * (more / far - z / far * std::expm1(-kappa * more));
    }
    return albedo_ / (4.0 * std::numbers::pi) * sum;
  }

  Dipole dipole_;
  Rectangle lit_;
  double albedo_;
};

// The top of a 30 x 30 x 10 mm plate, its rows a strip along x.
class LitPlate {
 public:
  explicit LitPlate(double patch_mm, const Rectangle& lit = {}, double strip_mm = 3.0)
      : patches_(make_box({-15, -15, -10}, {15, 15, 0}), patch_mm), lit_(lit) {
    for (int k = 0; k < patches_.size(); ++k) {
      if (patches_.normal(k).z() < 0.5) continue;
      const Eigen::Vector3d c = patches_.center_mm(k);
      if (c.x() > lit.x0 && c.x() < lit.x1 && c.y() > lit.y0 && c.y() < lit.y1) {
        light_.lit.push_back({patches_.corners_mm(k), {1.0, 1.0, 1.0}, k});
      }
      if (std::abs(c.y()) < strip_mm) rows_.push_back(k);
    }
  }

  const IncidentLight& light() const { return light_; }
  const PatchMesh& patches() const { return patches_; }
  const std::vector<int>& rows() const { return rows_; }

  // What a camera sees; the light stands `shift_mm` further along x than the model believes.
  Eigen::VectorXd image(const Medium& medium, double shift_mm = 0.0) const {
    const Dipole dipole(medium);
    const LitRectangle light(dipole, {lit_.x0 + shift_mm, lit_.x1, lit_.y0, lit_.y1});
    Eigen::VectorXd l(static_cast<Eigen::Index>(rows_.size()));
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      l[static_cast<Eigen::Index>(j)] =
          light.mean(patches_.corners_mm(rows_[j]), 1e-6 * dipole.total_reflectance());
    }
    return l;
  }

  DistanceKnots knots() const { return DistanceKnots(patches_.patch_size_mm() / 16.0, 44.0); }

  std::vector<ExitSite> sites() const {
    std::vector<ExitSite> out;
    for (int k : rows_) out.push_back(exit_patch(patches_, k));
    return out;
  }

  WeightMatrix weights(const DistanceKnots& k) const {
    PairSumOptions options;
    options.floor_mm = k.resolution_mm();
    return smooth_weights(sites(), SourceCloud(light_, {0, 0, 0}), k, options);
  }

 private:
  PatchMesh patches_;
  Rectangle lit_;
  IncidentLight light_;
  std::vector<int> rows_;
};

// As the instrument fits: with the errors of its own numerics, from a first fit.
inline DipoleFit fit_with_numerics(DenseSystem system, const DistanceKnots& knots, double patch_mm,
                                   const DipoleFitOptions& options) {
  DipoleFit first = fit_dipole(system, knots, options);
  if (!first.estimate.converged) return first;
  const DipoleSolver::Point& p = first.optimum;
  const Eigen::VectorXd r =
      std::exp(p.log_s) * dipole_curve(knots, p.u, p.q, options.eta_int_over_ext).r;
  system.std_l = (system.std_l.array().square() +
                  (row_numerics(patch_mm, std::exp(-p.u)) * system.l.array()).square())
                     .sqrt();
  add_numerics(knots, r, patch_mm,
               {p.sigma_s_prime_per_mm(), p.sigma_a_per_mm(), options.eta_int_over_ext}, system);
  return fit_dipole(system, knots, options);
}

// Whether an answer that may be trusted must not be: the truth beyond the 95 % interval widened to
// five deviations, and off by more than matters.
inline bool is_wrong(const Quantity& q, double truth, double matters) {
  constexpr double kWider = 5.0 / 1.96;
  const double low = q.low95 > 0.0 ? q.value - kWider * (q.value - q.low95) : 0.0;
  const double high = q.value + kWider * (q.high95 - q.value);
  return (truth < low || truth > high) && std::abs(q.value - truth) > matters;
}

inline bool is_wrong(const Estimate& e, const Medium& truth) {
  return e.reasons.empty() &&
         (is_wrong(e.sigma_s_prime_per_mm, truth.sigma_s_prime_per_mm,
                   0.01 * truth.sigma_s_prime_per_mm) ||
          is_wrong(e.sigma_a_per_mm, truth.sigma_a_per_mm, 0.05 * truth.sigma_a_per_mm + 1e-5));
}

}  // namespace scattermeter::test_support
