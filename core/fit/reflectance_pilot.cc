#include "core/fit/reflectance_pilot.h"

#include <cmath>
#include <numbers>

#include "core/base/log_linear_fit.h"

namespace scattermeter {

Eigen::VectorXd log_squared_depth(const DistanceKnots& knots, double source_depth_mm) {
  Eigen::VectorXd t(knots.size());
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    t[i] =
        2.0 * std::log(std::hypot(knots.knots_mm()[static_cast<std::size_t>(i)], source_depth_mm));
  }
  return t;
}

std::optional<ReflectancePilot> reflectance_pilot(const MarginalInformation& nominal,
                                                  const MarginalInformation& image,
                                                  const DistanceKnots& knots) {
  std::optional<ReflectancePilot> best;
  for (double z0 = knots.resolution_mm(); z0 < knots.max_distance_mm(); z0 *= std::numbers::sqrt2) {
    const Eigen::VectorXd t = log_squared_depth(knots, z0);
    LogLinearProblem problem{nominal.kernel, nominal.data, Eigen::MatrixXd(t.size(), 3),
                             Eigen::MatrixXd::Zero(2, 3)};
    problem.basis.col(0).setOnes();
    problem.basis.col(1) = t[0] - t.array();
    problem.basis.col(2) = 1.0 - (0.5 * (t.array() - t[0])).exp();
    // Keeps p and b z0 from running away where the image does not determine them.
    problem.penalty(0, 1) = problem.penalty(1, 2) = 0.01;
    // The static dipole's power, and half of it with a tail.
    for (const Eigen::Vector3d& shape :
         {Eigen::Vector3d(0.0, 1.5, 0.0), Eigen::Vector3d(0, 0.75, 0.3)}) {
      const Eigen::VectorXd p = nominal.kernel * (problem.basis * shape).array().exp().matrix();
      const double level = p.dot(nominal.data) / p.squaredNorm();
      if (!std::isfinite(level) || !(level > 0.0)) continue;
      const LogLinearFit there =
          fit_log_linear(problem, Eigen::Vector3d(std::log(level), shape[1], shape[2]));
      const LogLinearFit fit =
          fit_log_linear({image.kernel, image.data, problem.basis, problem.penalty}, there.theta);
      if (!best || fit.chi2 < best->chi2) best = {z0, problem.basis * fit.theta, fit.chi2};
    }
  }
  return best;
}

}  // namespace scattermeter
