#include "core/agreement/shot_agreement.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "core/base/chi_square.h"
#include "core/base/dense_solve.h"
#include "core/diffusion/dipole_curve.h"

namespace scattermeter {
namespace {

// Least squares in the normal form A x = b; the fall of the cost that the best x brings, b^T x.
struct Normal {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;

  explicit Normal(Eigen::Index n) : a(Eigen::MatrixXd::Zero(n, n)), b(Eigen::VectorXd::Zero(n)) {}
  double fall() const {
    const Eigen::VectorXd s =
        a.diagonal().unaryExpr([](double d) { return d > 0.0 ? 1.0 / std::sqrt(d) : 0.0; });
    Eigen::MatrixXd scaled = s.asDiagonal() * a * s.asDiagonal();
    // Directions that nothing determines bring no fall.
    scaled.diagonal().array() += 1e-12;
    const Eigen::VectorXd right = s.cwiseProduct(b);
    return right.dot(SymmetricSolver(scaled).solve(right));
  }
};

}  // namespace

ShotAgreement shot_agreement(const std::vector<ShotInformation>& shots,
                             const std::vector<Nuisance>& nuisances, const DistanceKnots& knots,
                             const DipoleSolver::Point& joint, double eta_int_over_ext,
                             const ScalePrior& scale, double noise_inflation) {
  const auto n_shots = static_cast<Eigen::Index>(shots.size());
  ShotAgreement out;
  if (n_shots < 2) return out;
  const double s = std::exp(joint.log_s);
  const DipoleCurve curve = dipole_curve(knots, joint.u, joint.q, eta_int_over_ext);
  const bool scale_moves = scale.relative_std > 0.0;
  const Eigen::Index first_nuisance = scale_moves ? 1 : 0;
  // By nuisance, which of the shared unknowns it is. Exact ones do not move.
  std::vector<std::optional<Eigen::Index>> shared_of(nuisances.size());
  Eigen::Index shared = first_nuisance;
  for (std::size_t v = 0; v < nuisances.size(); ++v) {
    if (nuisances[v].std > 0.0) shared_of[v] = shared++;
  }
  Normal together(2 + shared);
  Normal apart(2 * n_shots + shared);
  const Eigen::Index n_knots = curve.r.size();
  for (Eigen::Index i = 0; i < n_shots; ++i) {
    const ShotInformation& shot = shots[static_cast<std::size_t>(i)];
    const auto own = static_cast<Eigen::Index>(shot.nuisances.size());
    // The shot's unknowns (r on the knots, nuisances) by those that move here, and where those
    // are among the shared ones.
    std::vector<Eigen::Index> moving;
    for (Eigen::Index k = 0; k < own; ++k) {
      const auto v = static_cast<std::size_t>(shot.nuisances[static_cast<std::size_t>(k)]);
      if (shared_of[v]) moving.push_back(k);
    }
    const auto n_moving = static_cast<Eigen::Index>(moving.size());
    Eigen::MatrixXd by = Eigen::MatrixXd::Zero(n_knots + own, 2 + first_nuisance + n_moving);
    by.col(0).head(n_knots) = s * curve.d_u;
    by.col(1).head(n_knots) = s * curve.d_q;
    std::vector<Eigen::Index> indices;
    if (scale_moves) {
      by.col(2).head(n_knots) = s * curve.r;
      indices.push_back(0);
    }
    Eigen::VectorXd at = Eigen::VectorXd::Zero(n_knots + own);
    at.head(n_knots) = s * curve.r;
    for (Eigen::Index m = 0; m < n_moving; ++m) {
      const Eigen::Index k = moving[static_cast<std::size_t>(m)];
      const auto v = static_cast<std::size_t>(shot.nuisances[static_cast<std::size_t>(k)]);
      by(n_knots + k, 2 + first_nuisance + m) = 1.0;
      indices.push_back(*shared_of[v]);
      if (v < joint.v.size()) at[n_knots + k] = joint.v[v];
    }
    const Eigen::MatrixXd moved = shot.image.information * by;
    const Eigen::MatrixXd jj = by.transpose() * moved / noise_inflation;
    const Eigen::VectorXd jr =
        (by.transpose() * shot.image.right - moved.transpose() * at) / noise_inflation;
    const auto add = [&](Normal& normal, Eigen::Index coefficients, Eigen::Index first_shared) {
      std::vector<Eigen::Index> to = {coefficients, coefficients + 1};
      for (const Eigen::Index p : indices) to.push_back(first_shared + p);
      normal.a(to, to) += jj;
      normal.b(to) += jr;
    };
    add(together, 0, 2);
    add(apart, 2 * i, 2 * n_shots);
  }
  // Priors: (value + change)^2 / std^2.
  const auto prior = [&](Eigen::Index parameter, double value, double std) {
    if (!std::isfinite(std)) return;
    for (auto [normal, first] :
         {std::pair{&together, Eigen::Index{2}}, std::pair{&apart, 2 * n_shots}}) {
      normal->a(first + parameter, first + parameter) += 1.0 / (std * std);
      normal->b[first + parameter] -= value / (std * std);
    }
  };
  if (scale_moves) prior(0, joint.log_s, scale.relative_std);
  for (std::size_t v = 0; v < nuisances.size(); ++v) {
    if (!shared_of[v]) continue;
    prior(*shared_of[v], v < joint.v.size() ? joint.v[v] : 0.0, nuisances[v].std);
  }
  out.chi2 = as_chi_square(apart.fall() - together.fall());
  out.dof = static_cast<int>(2 * (n_shots - 1));
  out.p_value = chi_square_tail(out.chi2, out.dof);
  return out;
}

ShotAgreement agreement_of(const Eigen::VectorXd& estimates, const Eigen::MatrixXd& covariance) {
  const Eigen::Index n = estimates.size();
  if (n % 2 != 0 || covariance.rows() != n || covariance.cols() != n) {
    throw std::invalid_argument("agreement_of: sizes");
  }
  ShotAgreement out;
  out.dof = std::max(0, static_cast<int>(n) - 2);
  if (out.dof == 0) return out;
  // In units that make a row of the covariance as large as another.
  const Eigen::VectorXd unit = covariance.diagonal().cwiseSqrt();
  const Eigen::VectorXd x = estimates.cwiseQuotient(unit);
  const Eigen::MatrixXd c =
      unit.cwiseInverse().asDiagonal() * covariance * unit.cwiseInverse().asDiagonal();
  Eigen::MatrixXd common(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) common.row(i) = Eigen::RowVector2d::Unit(i % 2) / unit[i];
  const SymmetricSolver solver(c);
  const Eigen::MatrixXd weighed = solver.solve_columns(common);
  const Eigen::Vector2d best =
      SymmetricSolver(common.transpose() * weighed).solve(weighed.transpose() * x);
  const Eigen::VectorXd rest = x - common * best;
  out.chi2 = as_chi_square(rest.dot(solver.solve(rest)));
  out.p_value = chi_square_tail(out.chi2, out.dof);
  return out;
}

void widen_by_disagreement(const ShotAgreement& agreement, Estimate& estimate) {
  if (!agreement.disagree()) return;
  const double birge = std::sqrt(std::max(1.0, agreement.chi2 / agreement.dof));
  const double added = std::sqrt(birge * birge - 1.0);
  const double by_s = added * estimate.sigma_s_prime_per_mm.std;
  const double by_a = added * estimate.sigma_a_per_mm.std;
  widen({"disagreement", by_s, by_a}, estimate.correlation * by_s * by_a, estimate);
}

}  // namespace scattermeter
