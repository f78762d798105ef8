// A synthetic image whose truth does not come from the project's own pair sums.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/dipole.h"
#include "core/distance_weights.h"
#include "core/linear_shot.h"
#include "tests/core/boxes.h"
#include "tests/core/noisy_system.h"

namespace scattermeter::test_support {

// The top of a 30 x 30 x 10 mm plate lit evenly where x > 0 (1 W/mm^2 behind the surface). l at a
// point of the top is the integral over the lit rectangle x 0..15, y -15..15 in polar coordinates
// about the point: the arc of each circle that lies in a rectangle is known in closed form.
class HalfLitPlate {
 public:
  static constexpr double kHalf = 15.0;

  explicit HalfLitPlate(double patch_mm)
      : patches_(make_box({-kHalf, -kHalf, -10}, {kHalf, kHalf, 0}), patch_mm) {
    for (int k = 0; k < patches_.size(); ++k) {
      if (patches_.normal(k).z() < 0.5) continue;
      const Eigen::Vector3d c = patches_.center_mm(k);
      if (c.x() > 0.0) light_.lit.push_back({patches_.corners_mm(k), {1.0, 1.0, 1.0}, k});
      if (std::abs(c.y()) < 3.0) rows_.push_back(k);
    }
  }

  const PatchMesh& patches() const { return patches_; }
  const IncidentLight& light() const { return light_; }
  const std::vector<int>& rows() const { return rows_; }

  // l over the middles of the rows' edges (exact for quadratics), by quadrature.
  Eigen::VectorXd image(const Dipole& dipole) const {
    Eigen::VectorXd l(static_cast<Eigen::Index>(rows_.size()));
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      const auto c = patches_.corners_mm(rows_[j]);
      double sum = 0.0;
      // Cowper's six-point rule of degree 4.
      for (const auto& [a, w] : {std::pair{0.108103018168070, 0.223381589678011},
                                 std::pair{0.816847572980459, 0.109951743655322}}) {
        for (int i = 0; i < 3; ++i) {
          const double b = 0.5 * (1.0 - a);
          sum += w * at(dipole, a * c[static_cast<std::size_t>(i)] +
                                    b * (c[static_cast<std::size_t>((i + 1) % 3)] +
                                         c[static_cast<std::size_t>((i + 2) % 3)]));
        }
      }
      l[static_cast<Eigen::Index>(j)] = sum;
    }
    return l;
  }

  DistanceKnots knots() const { return DistanceKnots(patches_.patch_size_mm() / 16.0, 44.0); }

  WeightMatrix weights(const DistanceKnots& k) const {
    PairSumOptions options;
    options.floor_mm = k.resolution_mm();
    return smooth_weights(sites(), SourceCloud(light_, {0, 0, 0}), k, options);
  }

  std::vector<ExitSite> sites() const {
    std::vector<ExitSite> out;
    for (int k : rows_) out.push_back(exit_patch(patches_, k));
    return out;
  }

 private:
  // ∫ over the lit rectangle of R(rho).
  static double at(const Dipole& dipole, const Eigen::Vector3d& p) {
    // Sum over four quadrants' signed corners: the rectangle as four right-angled rectangles at p.
    const double x0 = 0.0 - p.x(), x1 = kHalf - p.x(), y0 = -kHalf - p.y(), y1 = kHalf - p.y();
    return corner(dipole, x1, y1) - corner(dipole, x0, y1) - corner(dipole, x1, y0) +
           corner(dipole, x0, y0);
  }

  // ∫ over [0, x] x [0, y] of R, signed. For a corner rectangle the angle integral splits at the
  // diagonal: each part is ∫ dphi G(side / cos phi), with G(rho) = ∫_0^rho R rho' drho' in closed
  // form.
  static double corner(const Dipole& dipole, double x, double y) {
    const double sign = (x < 0 ? -1.0 : 1.0) * (y < 0 ? -1.0 : 1.0);
    x = std::abs(x);
    y = std::abs(y);
    if (x == 0.0 || y == 0.0) return 0.0;
    double sum = 0.0;
    for (const auto& [near, far] : {std::pair{x, y}, std::pair{y, x}}) {
      const double angle = std::atan2(far, near);
      constexpr int kSteps = 64;  // Gauss-Legendre would do with fewer; the integrand is smooth
      for (int i = 0; i < kSteps; ++i) {
        // Two-point Gauss in each step.
        for (double g : {0.5 - 0.28867513459481287, 0.5 + 0.28867513459481287}) {
          sum += inner(dipole, near / std::cos((i + g) * angle / kSteps)) * 0.5 * angle / kSteps;
        }
      }
    }
    return sign * sum;
  }

  // ∫_0^rho R(d) d dd = sum over poles of alpha'/(4 pi) z_i [exp(-x)/rho_i] from rho down to 0,
  // since d/d rho_i [-exp(-kappa rho_i) / rho_i] = (1 + kappa rho_i) exp(-kappa rho_i) / rho_i^2
  // and d dd = rho_i d rho_i.
  static double inner(const Dipole& dipole, double rho) {
    const double kappa = dipole.sigma_tr_per_mm();
    double sum = 0.0;
    for (double z : {dipole.z_r_mm(), dipole.z_v_mm()}) {
      const double far = std::sqrt(rho * rho + z * z);
      sum += z * (std::exp(-kappa * z) / z - std::exp(-kappa * far) / far);
    }
    // alpha' / (4 pi) from the total: total = alpha'/2 (exp(-kappa z_r) + exp(-kappa z_v)).
    const double albedo = 2.0 * dipole.total_reflectance() /
                          (std::exp(-kappa * dipole.z_r_mm()) + std::exp(-kappa * dipole.z_v_mm()));
    return albedo / (4.0 * std::numbers::pi) * sum;
  }

  PatchMesh patches_;
  IncidentLight light_;
  std::vector<int> rows_;
};

}  // namespace scattermeter::test_support
