#include "calib/radiance/response_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include <Eigen/Dense>

#include "core/base/dense_solve.h"

namespace scattermeter::calib {
namespace {

constexpr int kResponseTurns = 5;

// Columns: settings; for each shot an offset in level and one in black, if their priors are not 0;
// knots.
struct ResponseColumns {
  Eigen::Index settings, levels, blacks, knots;
  Eigen::Index level(std::size_t shot) const { return settings + static_cast<Eigen::Index>(shot); }
  Eigen::Index black(std::size_t shot) const {
    return settings + levels + static_cast<Eigen::Index>(shot);
  }
  Eigen::Index knot() const { return settings + levels + blacks; }
  Eigen::Index size() const { return settings + levels + blacks + knots; }
};

struct ResponseProblem {
  const std::vector<FlatSample>& samples;
  const std::vector<FlatShot>& shots;
  const std::vector<double>& settings_s;
  std::size_t n_places;
  std::vector<double> knots;
  ResponseFitOptions options;
  double shot_std = 0;
};

struct ResponseSolution {
  ResponseColumns columns{};
  Eigen::VectorXd x;
  Eigen::MatrixXd covariance;
  std::vector<double> log_light;
  Eigen::MatrixXd light_rows;  // places x columns: d log_light / d x
  Eigen::VectorXd residual, weight;
};

double variance_at(const FlatSample& f, double counts) {
  return f.variance_dark + f.variance_per_count * counts;
}

// The recorded counts for which log counts + G = log_light.
double recorded_at(const ResponseCurve& curve, double log_light, double start) {
  double y = start;
  for (int i = 0; i < 6; ++i) y = std::exp(log_light - curve.log_ratio_at(y));
  return y;
}

// Sums over the samples of a place, by which its log light is eliminated from the normal equations.
struct PlaceSums {
  double weight = 0, value = 0;
  Eigen::VectorXd row;
};

// One iteration with the `predicted` counts of every sample; without knots G is fixed at 0.
ResponseSolution solve_turn(const ResponseProblem& problem, const std::vector<double>& predicted,
                            bool with_knots) {
  ResponseSolution out;
  const bool levels = problem.shot_std > 0.0, blacks = problem.options.black_std_counts > 0.0;
  const auto n_shots = static_cast<Eigen::Index>(problem.shots.size());
  out.columns = {static_cast<Eigen::Index>(problem.settings_s.size()), levels ? n_shots : 0,
                 blacks ? n_shots : 0,
                 with_knots ? static_cast<Eigen::Index>(problem.knots.size()) : 0};
  const ResponseColumns& columns = out.columns;
  const auto n = static_cast<Eigen::Index>(problem.samples.size());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n, columns.size());
  Eigen::VectorXd value(n);
  out.weight.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const FlatSample& f = problem.samples[at];
    const double y = predicted[at];
    const std::size_t setting = problem.shots.at(f.shot).setting;
    const double relative_variance = variance_at(f, y) / (y * y);
    rows(i, static_cast<Eigen::Index>(setting)) = 1.0;
    if (levels) rows(i, columns.level(f.shot)) = 1.0;
    if (blacks) rows(i, columns.black(f.shot)) = 1.0 / y;
    if (with_knots) rows.row(i).tail(columns.knots) = -ResponseCurve::weights(problem.knots, y);
    // E log(y + noise) = log y - variance / (2 y^2).
    value[i] =
        std::log(f.counts) + 0.5 * relative_variance - std::log(problem.settings_s.at(setting));
    out.weight[i] = 1.0 / relative_variance;
  }
  const Eigen::MatrixXd weighted = out.weight.asDiagonal() * rows;
  Eigen::MatrixXd normal = rows.transpose() * weighted;
  const auto prior = [&](Eigen::Index from, Eigen::Index count, double std) {
    if (count > 0) normal.diagonal().segment(from, count).array() += 1.0 / (std * std);
  };
  prior(0, columns.settings, problem.options.stated_time_std);
  prior(columns.settings, columns.levels, problem.shot_std);
  prior(columns.settings + columns.levels, columns.blacks, problem.options.black_std_counts);
  Eigen::VectorXd moment = weighted.transpose() * value;
  std::vector<PlaceSums> places(problem.n_places);
  for (PlaceSums& p : places) p.row = Eigen::VectorXd::Zero(columns.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    PlaceSums& p = places[problem.samples[static_cast<std::size_t>(i)].place];
    p.weight += out.weight[i];
    p.value += out.weight[i] * value[i];
    p.row += weighted.row(i).transpose();
  }
  for (const PlaceSums& p : places) {
    if (!(p.weight > 0.0)) continue;
    normal.noalias() -= p.row * (p.row / p.weight).transpose();
    moment -= p.row * (p.value / p.weight);
  }
  const Eigen::VectorXd scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const SymmetricSolver solver(scale.asDiagonal() * normal * scale.asDiagonal());
  out.x = scale.cwiseProduct(solver.solve(scale.cwiseProduct(moment)));
  out.covariance = scale.asDiagonal() * solver.inverse() * scale.asDiagonal();
  out.log_light.assign(problem.n_places, std::numeric_limits<double>::quiet_NaN());
  out.light_rows =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(problem.n_places), columns.size());
  for (std::size_t k = 0; k < problem.n_places; ++k) {
    const PlaceSums& p = places[k];
    if (!(p.weight > 0.0)) continue;
    out.log_light[k] = (p.value - p.row.dot(out.x)) / p.weight;
    out.light_rows.row(static_cast<Eigen::Index>(k)) = -p.row.transpose() / p.weight;
  }
  out.residual = value - rows * out.x;
  for (Eigen::Index i = 0; i < n; ++i) {
    out.residual[i] -= out.log_light[problem.samples[static_cast<std::size_t>(i)].place];
  }
  return out;
}

ResponseCurve curve_of(const ResponseProblem& problem, const ResponseSolution& solution) {
  if (solution.columns.knots == 0) return {};
  const Eigen::VectorXd values = solution.x.tail(solution.columns.knots);
  return {problem.knots, {values.begin(), values.end()}};
}

ResponseSolution solve_response(const ResponseProblem& problem) {
  std::vector<double> predicted;
  for (const FlatSample& f : problem.samples) predicted.push_back(f.counts);
  ResponseSolution solution;
  for (int turn = 0; turn < kResponseTurns; ++turn) {
    solution = solve_turn(problem, predicted, turn > 0);
    const ResponseCurve curve = curve_of(problem, solution);
    for (std::size_t i = 0; i < predicted.size(); ++i) {
      const FlatSample& f = problem.samples[i];
      const auto setting = static_cast<Eigen::Index>(problem.shots[f.shot].setting);
      // Without the level and black of each shot, which are negligible here.
      predicted[i] =
          recorded_at(curve,
                      solution.log_light[f.place] + solution.x[setting] +
                          std::log(problem.settings_s[static_cast<std::size_t>(setting)]),
                      f.counts);
    }
  }
  return solution;
}

// Standard deviation of the shots of one setting beyond the noise and black of their samples; 0 if
// chance explains it.
double shot_scatter(const ResponseProblem& problem, const ResponseSolution& solution) {
  std::vector<double> weight(problem.shots.size(), 0.0), sum = weight, inverse = weight;
  for (Eigen::Index i = 0; i < solution.residual.size(); ++i) {
    const FlatSample& f = problem.samples[static_cast<std::size_t>(i)];
    weight[f.shot] += solution.weight[i];
    sum[f.shot] += solution.weight[i] * solution.residual[i];
    inverse[f.shot] += solution.weight[i] / f.counts;
  }
  double squares = 0, expected = 0, pairs = 0;
  for (std::size_t i = 0; i < problem.shots.size(); ++i) {
    for (std::size_t k = i + 1; k < problem.shots.size(); ++k) {
      if (problem.shots[i].setting != problem.shots[k].setting) continue;
      if (!(weight[i] > 0.0) || !(weight[k] > 0.0)) continue;
      const double d = sum[i] / weight[i] - sum[k] / weight[k];
      const double black = problem.options.black_std_counts;
      squares += d * d;
      expected += 1.0 / weight[i] + 1.0 / weight[k] +
                  black * black *
                      (std::pow(inverse[i] / weight[i], 2) + std::pow(inverse[k] / weight[k], 2));
      pairs += 1.0;
    }
  }
  // The scatter of half a dozen pairs is itself uncertain.
  if (!(pairs > 0.0) || squares <= expected * (1.0 + 3.0 * std::sqrt(2.0 / pairs))) return 0.0;
  return std::sqrt(0.5 * (squares - expected) / pairs);
}

}  // namespace

void ResponseFitOptions::Check() const {
  if (knots < 1 || knots > 4) throw std::invalid_argument("ResponseFitOptions: knots");
  if (!(stated_time_std > 0.0)) throw std::invalid_argument("ResponseFitOptions: stated_time_std");
  if (!(black_std_counts >= 0.0)) {
    throw std::invalid_argument("ResponseFitOptions: black_std_counts");
  }
}

ResponseFit fit_response(const std::vector<FlatSample>& samples, const std::vector<FlatShot>& shots,
                         const std::vector<double>& settings_s, std::size_t n_places,
                         const ResponseFitOptions& options) {
  options.Check();
  double top = 0;
  std::vector<std::set<std::size_t>> settings_of_place(n_places);
  std::set<std::size_t> settings_seen;
  for (const FlatSample& f : samples) {
    if (!(f.counts > 0.0) || !(variance_at(f, f.counts) > 0.0)) {
      throw std::invalid_argument("fit_response: counts " + std::to_string(f.counts) +
                                  " with variance " + std::to_string(variance_at(f, f.counts)));
    }
    top = std::max(top, f.counts);
    settings_of_place.at(f.place).insert(shots.at(f.shot).setting);
    settings_seen.insert(shots.at(f.shot).setting);
  }
  ResponseFit out;
  const bool linked = std::any_of(settings_of_place.begin(), settings_of_place.end(),
                                  [](const auto& s) { return s.size() > 1; });
  if (settings_seen.size() < 3 || settings_seen.size() != settings_s.size() || !linked) return out;
  std::vector<double> knots;
  for (std::size_t k = 1; k <= options.knots; ++k) {
    knots.push_back(top * static_cast<double>(k) / static_cast<double>(options.knots));
  }
  ResponseProblem problem{samples, shots, settings_s, n_places, knots, options};
  ResponseSolution solution = solve_response(problem);
  out.shot_std = problem.shot_std = shot_scatter(problem, solution);
  if (out.shot_std > 0.0) solution = solve_response(problem);

  double chi2 = 0, relative = 0;
  for (Eigen::Index i = 0; i < solution.residual.size(); ++i) {
    const double r = solution.residual[i];
    chi2 += solution.weight[i] * r * r;
    relative += r * r;
    out.worst_sigma = std::max(out.worst_sigma, std::sqrt(solution.weight[i]) * std::abs(r));
  }
  const auto seen = std::count_if(settings_of_place.begin(), settings_of_place.end(),
                                  [](const auto& p) { return !p.empty(); });
  const double freedom = static_cast<double>(solution.residual.size()) - static_cast<double>(seen) -
                         static_cast<double>(settings_s.size() + options.knots);
  out.reduced_chi2 = freedom > 0.0 ? chi2 / freedom : 0.0;
  out.rms = std::sqrt(relative / static_cast<double>(solution.residual.size()));
  const double chance = freedom > 0.0 ? 1.0 + 3.0 * std::sqrt(2.0 / freedom) : 1.0;
  const double widen = out.reduced_chi2 > chance ? out.reduced_chi2 : 1.0;

  out.curve = curve_of(problem, solution);
  out.curve_covariance =
      widen * solution.covariance.bottomRightCorner(solution.columns.knots, solution.columns.knots);
  const Eigen::Index n = solution.columns.settings;
  const Eigen::MatrixXd center = Eigen::MatrixXd::Identity(n, n) -
                                 Eigen::MatrixXd::Constant(n, n, 1.0 / static_cast<double>(n));
  const Eigen::VectorXd log_times = solution.x.head(n);
  out.log_true_over_stated = center * log_times;
  out.setting_covariance = widen * center * solution.covariance.topLeftCorner(n, n) * center;
  Eigen::MatrixXd pick = Eigen::MatrixXd::Zero(n + solution.columns.knots, solution.columns.size());
  pick.topLeftCorner(n, n) = center;
  pick.bottomRightCorner(solution.columns.knots, solution.columns.knots).setIdentity();
  out.joint_covariance = widen * pick * solution.covariance * pick.transpose();
  out.light_rows.resize(solution.light_rows.rows(), n + solution.columns.knots);
  out.light_rows << solution.light_rows.leftCols(n),
      solution.light_rows.rightCols(solution.columns.knots);
  out.log_light_per_s = solution.log_light;
  for (double& l : out.log_light_per_s) l += log_times.mean();
  out.ok = solution.x.allFinite() && out.curve_covariance.allFinite();
  return out;
}

}  // namespace scattermeter::calib
