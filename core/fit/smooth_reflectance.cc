#include "core/fit/smooth_reflectance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "core/base/dense_solve.h"
#include "core/base/log_linear_fit.h"
#include "core/base/log_spline.h"
#include "core/fit/marginal_information.h"
#include "core/fit/reflectance_pilot.h"

namespace scattermeter {
namespace {

constexpr double kMinStep = std::numbers::ln2 / 3.0;  // in t, between breaks
// lambda considered: from smoother than any material is (dipoles seen without noise ask for 1 to
// 400) to what leaves r to the image alone, in steps far finer than its likelihood.
constexpr double kLargestLog10 = 3.0;
constexpr double kSmallestLog10 = -5.0;
constexpr double kStepLog10 = 0.5;
// Of the level, the power, the tail and the depth: the penalty is blind to this many directions.
constexpr double kFreeShapes = 4.0;

// Breaks as indices into the DistanceKnots, and the information of the image between each and the
// next: squared inverse deviation of log r in the interval, all else known.
struct Breaks {
  std::vector<Eigen::Index> at;
  std::vector<double> information;
};

Breaks place_breaks(const MarginalInformation& image, const ReflectancePilot& pilot,
                    const Eigen::VectorXd& t, double wanted) {
  Breaks out;
  out.at.push_back(0);
  const Eigen::VectorXd r = pilot.log_r.array().exp();
  Eigen::VectorXd interval = Eigen::VectorXd::Zero(image.kernel.rows());
  for (Eigen::Index j = 0; j + 1 < t.size(); ++j) {
    interval += image.kernel.col(j) * r[j];
    if (t[j + 1] - t[out.at.back()] < kMinStep || interval.squaredNorm() < wanted) continue;
    out.at.push_back(j + 1);
    out.information.push_back(interval.squaredNorm());
    interval.setZero();
  }
  if (out.at.back() + 1 < t.size()) {
    out.at.push_back(t.size() - 1);
    out.information.push_back(
        (interval + image.kernel.col(t.size() - 1) * r[t.size() - 1]).squaredNorm());
  }
  return out;
}

struct Smoothed {
  double log10_lambda = 0;
  LogLinearFit fit;
  Eigen::MatrixXd jacobian;      // of the image
  Eigen::MatrixXd inverse_root;  // S with S S^T = inverse of J^T J + lambda Q^T Q
  double effective_parameters = 0;
  double probability = 0;  // of this lambda among those tried
  double criterion = 0;    // -2 log marginal likelihood, up to a constant
};

// Q with |Q theta|^2 the penalty of lambda = 1: the spline's roughness, less what a small change of
// the depth would explain, log(d^2 + z^2) - t being proportional to exp(-t) to first order.
Eigen::MatrixXd penalty_root(const LogSpline& spline, const Eigen::MatrixXd& basis,
                             const Eigen::VectorXd& t) {
  Eigen::MatrixXd q = spline.roughness();
  const Eigen::VectorXd depth = (t[0] - t.array()).exp();
  const Eigen::VectorXd explained = (q * PivotedSolver(basis).solve(depth)).normalized();
  q -= explained * (explained.transpose() * q).eval();
  return q;
}

// One lambda.
Smoothed smooth_at(LogLinearProblem& problem, const Eigen::MatrixXd& roughness, double log10_lambda,
                   const Eigen::VectorXd& start, double floor_chi2, double rows) {
  Smoothed out;
  out.log10_lambda = log10_lambda;
  problem.penalty = std::pow(10.0, 0.5 * log10_lambda) * roughness;
  out.fit = fit_log_linear(problem, start);
  out.jacobian = log_linear_jacobian(problem, out.fit.theta);
  const Eigen::Index n = start.size();
  Eigen::MatrixXd all(out.jacobian.rows() + roughness.rows(), n);
  all << out.jacobian, problem.penalty;
  const PivotedSolver qr(all);
  Eigen::MatrixXd root = qr.r();
  // A direction that neither the image nor smoothness determines keeps a huge deviation.
  const double least = std::max(1e-14 * std::abs(root(0, 0)), 1e-150);
  double log_determinant = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (std::abs(root(i, i)) < least) root(i, i) = least;
    log_determinant += 2.0 * std::log(std::abs(root(i, i)));
  }
  out.inverse_root =
      qr.unpermute_rows(root.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n)));
  out.effective_parameters = (out.jacobian * out.inverse_root).squaredNorm();
  // What costs nothing is integrated over.
  const double cost = out.fit.chi2 + floor_chi2 + out.fit.penalty;
  const double dof = std::max(1.0, rows - kFreeShapes);
  const double variance = std::max(1.0, cost / dof);
  out.criterion = dof * std::log(variance) + cost / variance + log_determinant -
                  (static_cast<double>(n) - kFreeShapes) * std::numbers::ln10 * log10_lambda;
  return out;
}

// The lambdas tried, each with its probability, all being alike before the image is seen.
std::vector<Smoothed> smooth(LogLinearProblem& problem, const Eigen::MatrixXd& roughness,
                             Eigen::VectorXd start, double floor_chi2, double rows) {
  std::vector<Smoothed> tried;
  double best = std::numeric_limits<double>::infinity();
  for (double log10_lambda = kLargestLog10; log10_lambda >= kSmallestLog10;
       log10_lambda -= kStepLog10) {
    tried.push_back(smooth_at(problem, roughness, log10_lambda, start, floor_chi2, rows));
    start = tried.back().fit.theta;
    best = std::min(best, tried.back().criterion);
    // A probability of e^-10 of the best's, and falling: the rest does not count.
    if (tried.back().criterion > best + 20.0) break;
  }
  double sum = 0.0;
  for (Smoothed& s : tried) sum += s.probability = std::exp(-0.5 * (s.criterion - best));
  for (Smoothed& s : tried) s.probability /= sum;
  return tried;
}

// By the probabilities of the lambdas. theta_1 ... >= 0 of each makes the mean fall as well.
struct MeanOverLambda {
  Eigen::VectorXd theta;
  double log10_lambda = 0;
  double effective_parameters = 0;
  bool converged = true;
};

MeanOverLambda mean_over_lambda(const std::vector<Smoothed>& tried) {
  MeanOverLambda mean;
  mean.theta = Eigen::VectorXd::Zero(tried.front().fit.theta.size());
  for (const Smoothed& s : tried) {
    mean.theta += s.probability * s.fit.theta;
    mean.log10_lambda += s.probability * s.log10_lambda;
    mean.effective_parameters += s.probability * s.effective_parameters;
    mean.converged = mean.converged && (s.fit.converged || s.probability < 0.01);
  }
  return mean;
}

// Over which distances a knot averages: mean distance from it, by the magnitudes of d(log r there)
// / d(log r at every DistanceKnot). f: the knot's row of the basis.
double spread_mm(const Eigen::RowVectorXd& f, const Smoothed& best,
                 const MarginalInformation& image, const Eigen::VectorXd& r_per_mm2,
                 const DistanceKnots& knots, double distance_mm) {
  const Eigen::ArrayXd average =
      ((((f * best.inverse_root) * best.inverse_root.transpose()) * best.jacobian.transpose()) *
       image.kernel)
          .transpose()
          .array()
          .abs() *
      r_per_mm2.array();
  double spread = 0.0;
  for (Eigen::Index j = 0; j < average.size(); ++j) {
    spread += average[j] * std::abs(knots.knots_mm()[static_cast<std::size_t>(j)] - distance_mm);
  }
  return spread / std::max(average.sum(), 1e-300);
}

void add_reasons(bool converged, const ScalePrior& scale, SmoothReflectance& out) {
  if (!converged) out.reasons.push_back("the fit of the smooth reflectance did not converge");
  if (std::none_of(out.knots.begin(), out.knots.end(),
                   [](const ReflectanceKnot& k) { return k.determined; })) {
    out.reasons.push_back("these shots do not determine the reflectance at any distance");
  }
  if (scale.is_free()) {
    out.reasons.push_back("the scale is free: only the shape of the reflectance is known");
  }
}

}  // namespace

void SmoothReflectanceOptions::Check() const {
  if (!(scale.relative_std >= 0.0)) {
    throw std::invalid_argument("SmoothReflectanceOptions.scale");
  }
  if (!(max_log_std > 0.0)) throw std::invalid_argument("SmoothReflectanceOptions.max_log_std");
}

SmoothReflectance smooth_reflectance(const RecoveredReflectance& recovered,
                                     const std::vector<Nuisance>& nuisances,
                                     const DistanceKnots& knots,
                                     const SmoothReflectanceOptions& options) {
  options.Check();
  SmoothReflectance out;
  out.r_per_mm2 = Eigen::VectorXd::Zero(knots.size());
  if (!recovered.sqrt_information.allFinite() || !recovered.whitened.allFinite() ||
      !std::isfinite(recovered.floor_chi2)) {
    out.reasons.push_back("the system contains values that are not finite");
    return out;
  }
  const MarginalInformation image =
      marginal_information(recovered, nuisances, knots.size(), NuisanceUse::kFitted);
  const MarginalInformation nominal{
      recovered.sqrt_information.leftCols(knots.size()), recovered.whitened, {}};
  const std::optional<ReflectancePilot> pilot =
      recovered.whitened.size() > 0 ? reflectance_pilot(nominal, image, knots) : std::nullopt;
  if (!pilot) {
    out.reasons.push_back("no light reaches the object in these shots");
    return out;
  }
  out.source_depth_mm = pilot->source_depth_mm;
  const Eigen::VectorXd t = log_squared_depth(knots, pilot->source_depth_mm);
  const double wanted = 1.0 / (options.max_log_std * options.max_log_std);
  const Breaks breaks = place_breaks(image, *pilot, t, wanted);
  // The curve may bend everywhere, whatever is reported: with breaks only where the image is
  // informative it would be stiff, and its bars short, exactly where the image determines least.
  std::vector<double> break_t;
  for (Eigen::Index i : place_breaks(image, *pilot, t, 0.0).at) break_t.push_back(t[i]);
  const LogSpline spline(break_t);
  LogLinearProblem problem{image.kernel, image.data, Eigen::MatrixXd(t.size(), spline.size()), {}};
  for (Eigen::Index i = 0; i < t.size(); ++i) problem.basis.row(i) = spline.row(t[i]);
  Eigen::VectorXd start = PivotedSolver(problem.basis).solve(pilot->log_r);
  start.tail(start.size() - 1) = start.tail(start.size() - 1).cwiseMax(0.0);
  const auto rows = static_cast<double>(recovered.rows);
  const std::vector<Smoothed> tried =
      smooth(problem, penalty_root(spline, problem.basis, t), start, recovered.floor_chi2, rows);

  const MeanOverLambda mean = mean_over_lambda(tried);
  out.effective_parameters = mean.effective_parameters;
  out.smoothing_weight = std::pow(10.0, mean.log10_lambda);
  out.r_per_mm2 = (problem.basis * mean.theta).array().exp();
  out.reduced_chi2 =
      ((image.kernel * out.r_per_mm2 - image.data).squaredNorm() + recovered.floor_chi2) /
      std::max(1.0, rows - out.effective_parameters);
  const double inflation = std::max(1.0, out.reduced_chi2);
  const Smoothed& best = *std::max_element(
      tried.begin(), tried.end(),
      [](const Smoothed& a, const Smoothed& b) { return a.probability < b.probability; });
  const Eigen::MatrixXd held_moves = best.inverse_root * (best.inverse_root.transpose() *
                                                          (best.jacobian.transpose() * image.held));
  for (std::size_t k = 0; k < breaks.at.size(); ++k) {
    const Eigen::Index at = breaks.at[k];
    const Eigen::RowVectorXd f = problem.basis.row(at);
    ReflectanceKnot knot;
    knot.distance_mm = knots.knots_mm()[static_cast<std::size_t>(at)];
    knot.r_per_mm2 = out.r_per_mm2[at];
    double variance = (f * held_moves).squaredNorm();
    for (const Smoothed& s : tried) {
      variance += s.probability * (inflation * (f * s.inverse_root).squaredNorm() +
                                   std::pow(f.dot(s.fit.theta - mean.theta), 2));
    }
    knot.shape_log_std = std::sqrt(variance);
    knot.log_std = std::hypot(knot.shape_log_std, options.scale.relative_std);
    knot.low95_per_mm2 = knot.r_per_mm2 * std::exp(-1.96 * knot.log_std);
    knot.high95_per_mm2 = knot.r_per_mm2 * std::exp(1.96 * knot.log_std);
    knot.spread_mm = spread_mm(f, best, image, out.r_per_mm2, knots, knot.distance_mm);
    knot.determined = k < breaks.information.size() &&
                      breaks.information[k] >= inflation * wanted &&
                      knot.shape_log_std <= options.max_log_std;
    out.knots.push_back(knot);
  }
  add_reasons(mean.converged, options.scale, out);
  return out;
}

}  // namespace scattermeter
