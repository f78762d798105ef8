#include "core/fit/shot_departure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/base/dense_solve.h"

namespace scattermeter {
namespace {

// A least-squares problem whose columns carry priors of mean 0 and unit deviation (or none).
struct Solution {
  Eigen::VectorXd x;
  Eigen::MatrixXd covariance;
  double reduced_chi2 = 0;
};

Solution solve(const Eigen::MatrixXd& columns, const Eigen::VectorXd& rest,
               const std::vector<bool>& has_prior) {
  const Eigen::Index n = columns.cols();
  Eigen::MatrixXd normal = columns.transpose() * columns;
  const Eigen::VectorXd right = columns.transpose() * rest;
  // Columns of any size: scaled to a unit diagonal before the priors join.
  Eigen::MatrixXd with_priors = normal;
  int free = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (has_prior[static_cast<std::size_t>(i)]) {
      with_priors(i, i) += 1.0;
    } else {
      ++free;
    }
  }
  const Eigen::VectorXd unit = with_priors.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = unit.asDiagonal() * with_priors * unit.asDiagonal();
  const SymmetricSolver solver(scaled);
  Solution out;
  out.x = unit.cwiseProduct(solver.solve(unit.cwiseProduct(right)));
  out.covariance = unit.asDiagonal() * solver.inverse() * unit.asDiagonal();
  const double left = (rest - columns * out.x).squaredNorm();
  out.reduced_chi2 = left / std::max<double>(1.0, static_cast<double>(rest.size() - free));
  return out;
}

// The columns of the least-squares problem, in units of their priors and weighted by the rows'
// deviations: free coefficients, scale, nuisances, powers (of more than one shot), even light.
struct DepartureColumns {
  Eigen::Index at_scale, at_nuisance, at_power, at_even;
  Eigen::MatrixXd columns;
  std::vector<bool> has_prior;
  std::vector<double> nuisance_unit;  // of each nuisance: its standard deviation; 1 where infinite

  DepartureColumns(const DenseSystem& system, const LinearModel& model)
      : at_scale(model.jacobian.cols()),
        at_nuisance(at_scale + (model.scale_relative_std > 0.0 ? 1 : 0)),
        at_power(at_nuisance + static_cast<Eigen::Index>(system.nuisances.size())) {
    const auto n_shots = static_cast<Eigen::Index>(system.shot_rows.size());
    at_even = at_power + (n_shots > 1 ? n_shots : 0);
    columns = Eigen::MatrixXd::Zero(system.l.size(), at_even + n_shots);
    has_prior.assign(static_cast<std::size_t>(columns.cols()), true);
    columns.leftCols(at_scale) = model.jacobian;
    std::fill_n(has_prior.begin(), at_scale, false);
    if (at_nuisance > at_scale) {
      const bool is_free = !std::isfinite(model.scale_relative_std);
      columns.col(at_scale) = model.predicted * (is_free ? 1.0 : model.scale_relative_std);
      has_prior[static_cast<std::size_t>(at_scale)] = !is_free;
    }
    add_nuisances(system);
    add_shots(system, model);
    columns = (system.std_l.cwiseInverse().asDiagonal() * columns).eval();
  }

 private:
  void add_nuisances(const DenseSystem& system) {
    for (Eigen::Index at = at_nuisance; at < at_power; ++at) {
      const double std = system.nuisances[static_cast<std::size_t>(at - at_nuisance)].std;
      has_prior[static_cast<std::size_t>(at)] = std::isfinite(std);
      nuisance_unit.push_back(std::isfinite(std) ? std : 1.0);
      columns.col(at) = nuisance_unit.back() * system.nuisance_columns.col(at - at_nuisance);
    }
  }
  void add_shots(const DenseSystem& system, const LinearModel& model) {
    Eigen::Index first = 0;
    for (std::size_t i = 0; i < system.shot_rows.size(); ++i) {
      const auto s = static_cast<Eigen::Index>(i);
      const Eigen::Index count = system.shot_rows[i];
      const double mean_l = count > 0 ? system.l.segment(first, count).mean() : 0.0;
      if (at_even > at_power) {
        columns.col(at_power + s).segment(first, count) =
            kWidest * model.predicted.segment(first, count);
      }
      columns.col(at_even + s).segment(first, count).setConstant(kWidest * mean_l);
      first += count;
    }
  }
};

// Root mean square of `left` over that of l, by shot.
std::vector<double> relative_residuals(const DenseSystem& system, const Eigen::VectorXd& left) {
  std::vector<double> out;
  Eigen::Index first = 0;
  for (const Eigen::Index count : system.shot_rows) {
    const double light = system.l.segment(first, count).squaredNorm();
    out.push_back(light > 0.0 ? std::sqrt(left.segment(first, count).squaredNorm() / light) : 0.0);
    first += count;
  }
  return out;
}

// Of each shot, minus the mean over the shots.
std::vector<Departure> powers_less_mean(const Solution& fit, Eigen::Index at_power,
                                        Eigen::Index n_shots, double widened) {
  if (n_shots == 1) return {{0.0, std::numeric_limits<double>::infinity()}};
  std::vector<Departure> out;
  for (Eigen::Index s = 0; s < n_shots; ++s) {
    Eigen::VectorXd pick = Eigen::VectorXd::Constant(n_shots, -1.0 / static_cast<double>(n_shots));
    pick[s] += 1.0;
    pick *= kWidest;
    const double variance =
        pick.dot(fit.covariance.block(at_power, at_power, n_shots, n_shots) * pick);
    out.push_back(
        {pick.dot(fit.x.segment(at_power, n_shots)), widened * std::sqrt(std::max(0.0, variance))});
  }
  return out;
}

}  // namespace

ShotDepartures shot_departures(const DenseSystem& system, const LinearModel& model) {
  const Eigen::Index rows = system.l.size();
  const auto n_nuisances = static_cast<Eigen::Index>(system.nuisances.size());
  const auto n_shots = static_cast<Eigen::Index>(system.shot_rows.size());
  if (model.predicted.size() != rows || model.jacobian.rows() != rows || n_shots == 0 ||
      (n_nuisances > 0 && system.nuisance_columns.rows() != rows) ||
      system.nuisance_columns.cols() != n_nuisances) {
    throw std::invalid_argument("shot_departures: sizes do not agree");
  }
  const DepartureColumns c(system, model);
  const Eigen::VectorXd rest = system.std_l.cwiseInverse().cwiseProduct(system.l - model.predicted);
  ShotDepartures out;
  // The joint model alone, without departures of single shots.
  const auto joint = c.columns.leftCols(c.at_power);
  const Solution joint_fit =
      solve(joint, rest, {c.has_prior.begin(), c.has_prior.begin() + c.at_power});
  out.residual_relative =
      relative_residuals(system, (rest - joint * joint_fit.x).cwiseProduct(system.std_l));
  const Solution fit = solve(c.columns, rest, c.has_prior);
  out.reduced_chi2 = fit.reduced_chi2;
  const double widened = std::sqrt(std::max(1.0, fit.reduced_chi2));
  const auto departure = [&](Eigen::Index at, double unit) {
    return Departure{unit * fit.x[at],
                     widened * unit * std::sqrt(std::max(0.0, fit.covariance(at, at)))};
  };
  out.power_relative = powers_less_mean(fit, c.at_power, n_shots, widened);
  for (Eigen::Index s = 0; s < n_shots; ++s) {
    out.even_relative.push_back(departure(c.at_even + s, kWidest));
  }
  for (Eigen::Index i = 0; i < n_nuisances; ++i) {
    out.nuisances.push_back(
        departure(c.at_nuisance + i, c.nuisance_unit[static_cast<std::size_t>(i)]));
  }
  return out;
}

}  // namespace scattermeter
