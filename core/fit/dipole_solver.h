// The optimum of the dipole's chi-square.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/fit/estimate.h"
#include "core/fit/linear_shot.h"
#include "core/fit/recovered_reflectance.h"
#include "core/material/medium.h"

namespace scattermeter {

// Least squares of s R(d; sigma_s', sigma_a) and the nuisances v against the recovered r in the
// metric of r's own errors, that is, the image's chi-square, with the priors of s and v. Continuous
// in u = log sigma_t', q = 1 - alpha' in 0 .. 0.95 and log s (Ceres, analytic derivatives); v, in
// which the image is linear, is eliminated (variable projection; Golub and Pereyra 1973).
class DipoleSolver {
 public:
  struct Point {
    double u = 0;
    double q = 0;
    double log_s = 0;
    std::vector<double> v;
    double cost = 0;  // chi-square beyond the free r's (RecoveredReflectance::floor_chi2) + priors
    bool converged = false;
    static Point of(const Medium& medium, double scale);  // v, cost: as of a start
    double sigma_t_prime_per_mm() const;
    double sigma_s_prime_per_mm() const;
    double sigma_a_per_mm() const;
  };
  enum class Coefficient { kSigmaSPrime, kSigmaA };

  // fitted: the fitted nuisances, in the order of their columns, which follow the knots'.
  // `knots` must outlive the solver.
  DipoleSolver(const RecoveredReflectance& recovered, const DistanceKnots& knots,
               const std::vector<Nuisance>& fitted, double eta_int_over_ext,
               const ScalePrior& scale);

  // Started from every minimum on a coarse grid over all magnitudes that the knots can resolve, so
  // no initial guess is needed; and from `near`, such as the medium for which the nuisances'
  // columns are made.
  Point best(const std::optional<Point>& near = std::nullopt) const;
  // The optimum to which a search from this point leads, be there deeper ones or not.
  Point nearest(const Point& from) const;
  // The optimum with one coefficient held at a value (1/mm), for a profile likelihood. nullopt if
  // no point within the bounds has this value or the search fails.
  std::optional<Point> best_with(Coefficient held, double value_per_mm, const Point& start) const;

  static constexpr double kMaxAbsorbed = 0.95;  // upper bound of q

 private:
  Point freed(const Point& from) const;  // where a search from a point ends
  Point beside_bound(Point p) const;     // or on it, if it is better
  void set_nuisances(Point& p) const;

  const DistanceKnots& knots_;
  // The residual for any v is kernel s R - whitened with v at its optimum, which is
  // v_by_whitened - v_by_kernel s R.
  Eigen::MatrixXd kernel_, v_by_kernel_;
  Eigen::VectorXd whitened_, v_by_whitened_;
  double eta_;
  ScalePrior scale_;
};

}  // namespace scattermeter
