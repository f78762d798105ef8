#include "core/fit/shot_departure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "core/base/dense_solve.h"
#include "core/fit/residual.h"

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
  const Eigen::VectorXd weight = system.std_l.cwiseInverse();
  const Eigen::VectorXd rest = weight.cwiseProduct(system.l - model.predicted);
  // Free coefficients, scale, nuisances, powers (of more than one shot), even light.
  const Eigen::Index n_free = model.jacobian.cols();
  const bool scale_moves = model.scale_relative_std > 0.0;
  const bool scale_is_free = !std::isfinite(model.scale_relative_std);
  const Eigen::Index n_power = n_shots > 1 ? n_shots : 0;
  const Eigen::Index at_scale = n_free;
  const Eigen::Index at_nuisance = at_scale + (scale_moves ? 1 : 0);
  const Eigen::Index at_power = at_nuisance + n_nuisances;
  const Eigen::Index at_even = at_power + n_power;
  const Eigen::Index n = at_even + n_shots;
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows, n);
  std::vector<bool> has_prior(static_cast<std::size_t>(n), true);
  columns.leftCols(n_free) = model.jacobian;
  std::fill_n(has_prior.begin(), n_free, false);
  if (scale_moves) {
    columns.col(at_scale) = model.predicted * (scale_is_free ? 1.0 : model.scale_relative_std);
    has_prior[static_cast<std::size_t>(at_scale)] = !scale_is_free;
  }
  std::vector<double> unit(static_cast<std::size_t>(n_nuisances), 1.0);
  for (Eigen::Index i = 0; i < n_nuisances; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (std::isfinite(system.nuisances[k].std)) {
      unit[k] = system.nuisances[k].std;
    } else {
      has_prior[static_cast<std::size_t>(at_nuisance + i)] = false;
    }
    columns.col(at_nuisance + i) = unit[k] * system.nuisance_columns.col(i);
  }
  ShotDepartures out;
  const Eigen::Index joint = at_power;
  std::vector<double> mean_l;
  Eigen::Index first = 0;
  for (Eigen::Index s = 0; s < n_shots; ++s) {
    const Eigen::Index count = system.shot_rows[static_cast<std::size_t>(s)];
    mean_l.push_back(count > 0 ? system.l.segment(first, count).mean() : 0.0);
    if (n_power > 0) {
      columns.col(at_power + s).segment(first, count) =
          kWidest * model.predicted.segment(first, count);
    }
    columns.col(at_even + s).segment(first, count).setConstant(kWidest * mean_l.back());
    first += count;
  }
  columns = (weight.asDiagonal() * columns).eval();
  const Solution joint_fit =
      solve(columns.leftCols(joint), rest, {has_prior.begin(), has_prior.begin() + joint});
  const Eigen::VectorXd left =
      (rest - columns.leftCols(joint) * joint_fit.x).cwiseProduct(system.std_l);
  first = 0;
  for (const Eigen::Index count : system.shot_rows) {
    const double light = system.l.segment(first, count).squaredNorm();
    out.residual_relative.push_back(
        light > 0.0 ? std::sqrt(left.segment(first, count).squaredNorm() / light) : 0.0);
    first += count;
  }
  const Solution fit = solve(columns, rest, has_prior);
  out.reduced_chi2 = fit.reduced_chi2;
  const double widened = std::sqrt(std::max(1.0, fit.reduced_chi2));
  for (Eigen::Index s = 0; s < n_shots; ++s) {
    if (n_power == 0) {
      out.power_relative.push_back({0.0, std::numeric_limits<double>::infinity()});
    } else {
      // Less the mean over the shots.
      Eigen::VectorXd pick =
          Eigen::VectorXd::Constant(n_shots, -1.0 / static_cast<double>(n_shots));
      pick[s] += 1.0;
      pick *= kWidest;
      out.power_relative.push_back(
          {pick.dot(fit.x.segment(at_power, n_shots)),
           widened * std::sqrt(std::max(
                         0.0, pick.dot(fit.covariance.block(at_power, at_power, n_shots, n_shots) *
                                       pick)))});
    }
    const Eigen::Index e = at_even + s;
    out.even_relative.push_back(
        {kWidest * fit.x[e], widened * kWidest * std::sqrt(std::max(0.0, fit.covariance(e, e)))});
  }
  for (Eigen::Index i = 0; i < n_nuisances; ++i) {
    const double u = unit[static_cast<std::size_t>(i)];
    const Eigen::Index at = at_nuisance + i;
    out.nuisances.push_back(
        {u * fit.x[at], widened * u * std::sqrt(std::max(0.0, fit.covariance(at, at)))});
  }
  return out;
}

Departure common_slope(const std::vector<double>& x, const std::vector<double>& y,
                       const std::vector<int>& group) {
  if (x.size() != y.size() || x.size() != group.size()) {
    throw std::invalid_argument("common_slope: sizes do not agree");
  }
  struct Mean {
    double n = 0, x = 0, y = 0;
  };
  std::map<int, Mean> means;
  for (std::size_t i = 0; i < x.size(); ++i) {
    Mean& m = means[group[i]];
    m.n += 1.0;
    m.x += x[i];
    m.y += y[i];
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Mean& m = means[group[i]];
    const double dx = x[i] - m.x / m.n;
    const double dy = y[i] - m.y / m.n;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  Departure out{0.0, std::numeric_limits<double>::infinity()};
  if (!(xx > 0.0)) return out;
  out.value = xy / xx;
  const double dof = static_cast<double>(x.size()) - static_cast<double>(means.size()) - 1.0;
  if (dof > 0.0) out.std = std::sqrt(std::max(0.0, yy - xy * xy / xx) / dof / xx);
  return out;
}

}  // namespace scattermeter
