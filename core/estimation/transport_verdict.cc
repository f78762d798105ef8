#include "core/estimation/transport_verdict.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "core/base/median.h"
#include "core/estimation/channel_result.h"
#include "core/estimation/material_channel.h"
#include "core/estimation/transport_round.h"
#include "core/fit/prior_pulls.h"
#include "core/fit/residual.h"
#include "core/view/row_selection.h"

namespace scattermeter {
namespace {

// With a misfit this improbable and this large, the result is refused.
constexpr double kMisfitPValue = 1e-6;
constexpr double kMisfit = 0.003;
// A residual that exceeds noise and Monte Carlo by this share of the image is refused: more than
// what rows may scatter.
constexpr double kUnexplained = 0.05;
// The same for the stated scale, a single direction: an offset of three standard deviations widens
// the result by it, one of 4.4 that exceeds a per cent refuses it.
constexpr double kWideningScalePValue = 3e-3;
constexpr double kRefusedScalePValue = 1e-5;
constexpr double kRefusedScale = 0.01;

const Eigen::MatrixXd& covariance_by(const ScatteringEquation::Step& step,
                                     const std::string& cause) {
  return std::find_if(step.causes.begin(), step.causes.end(),
                      [&](const auto& c) { return c.name == cause; })
      ->covariance;
}

// How far the image is off: `rest`, before and after (`settled`) the nuisances take their most
// probable values, the latter against `variance`; W/mm^2 and its square, of the system's rows.
void report_residual(const DenseSystem& system, const Eigen::VectorXd& rest,
                     const Eigen::VectorXd& settled, const Eigen::VectorXd& variance,
                     Estimate& estimate) {
  estimate.reduced_chi2 = settled.cwiseAbs2().cwiseQuotient(variance).mean();
  const Residual whole = residual(system.l, system.l - rest, system.std_l);
  estimate.rms_relative = whole.rms_relative;
  estimate.psnr_db = whole.psnr_db;
  estimate.rows = static_cast<std::size_t>(system.l.size());
}

// The step, with a larger covariance if the image contradicts the stated scale.
ScatteringEquation::Step widened_by_scale(const ScatteringEquation& equation,
                                          const ScatteringEquation::ScaleTest& scale,
                                          ScatteringEquation::Step step) {
  if (scale.p_value < kWideningScalePValue) equation.widen_by_scale(scale.offset, step);
  return step;
}

}  // namespace

PathErrors first_errors(int blocks, int final_blocks) {
  return {1.0 + static_cast<double>(blocks) / final_blocks, blocks, final_blocks};
}

bool fits_weights(const PathErrors& found, const PathErrors& assumed) {
  constexpr double kLike = 1.5;
  return found.of_block() < kLike * assumed.of_block();
}

bool is_close(const ScatteringEquation::Step& step, int blocks, const LackOfFit& misfit) {
  constexpr double kShort = 0.02;
  const double longest = misfit.p_value < kWideningPValue ? 0.05 : 0.25;
  constexpr double kOfStd = 0.15;
  const double more = blocks > kLeastBlocks ? 1.7 : 1.0;
  const Eigen::MatrixXd& paths = covariance_by(step, "Monte Carlo");
  const double saved = 1.0 - std::min(1.0, static_cast<double>(blocks) / kFinalPathBlocks);
  for (Eigen::Index k = 0; k < step.taken.size(); ++k) {
    const double change = std::abs(step.taken[k]) * step.size[k] / more;
    // Whatever the deviation: it is that of a point too far off.
    if (change > longest) return false;
    const double std = std::sqrt(step.covariance(k, k) - saved * paths(k, k)) * step.size[k];
    if (change > kShort && 0.5 * change * change > kOfStd * std) return false;
  }
  return true;
}

bool is_noise(const ScatteringEquation::Step& step) {
  constexpr double kStds = 2.0;
  const Eigen::ArrayXd std = step.covariance.diagonal().cwiseSqrt();
  return step.change < kStds * (std * step.size.array()).maxCoeff();
}

bool is_precise(const ScatteringEquation::Step& step, double sigma_a_per_mm, int blocks) {
  constexpr double kOfRest = 0.1;  // of the variance
  constexpr double kFloor[2] = {1e-3, 5e-3};
  const double unit[2] = {1.0, std::max(sigma_a_per_mm, 1e-3)};
  for (Eigen::Index k = 0; k < 2; ++k) {
    const double own = covariance_by(step, "Monte Carlo")(k, k);
    const double rest = step.covariance(k, k) - own;
    const double floor = kFloor[k] * unit[k];
    if (own > kOfRest * rest && own > floor * floor) return false;
  }
  return blocks >= kLeastBlocks;
}

bool is_in_doubt(const LackOfFit& misfit, const std::vector<PriorPull>& pulls) {
  constexpr double kNearlyContradicted = 3.0;
  const bool is_refused = (misfit.p_value < kMisfitPValue && misfit.rms > kMisfit) ||
                          contradiction(pulls, kMostPull, kLeastPullImage) != nullptr;
  return !is_refused && (misfit.p_value < kWideningPValue ||
                         contradiction(pulls, kNearlyContradicted, kLeastPullImage) != nullptr);
}

void report_step(const ScatteringEquation::Step& step, Estimate& estimate) {
  const double s = step.to.sigma_s_per_mm;
  const Eigen::MatrixXd& c = step.covariance;
  estimate.converged = true;
  estimate.sigma_s_prime_per_mm = normal_quantity(s, s * std::sqrt(c(0, 0)));
  estimate.sigma_a_per_mm = normal_quantity(step.to.sigma_a_per_mm, std::sqrt(c(1, 1)));
  estimate.correlation = c(0, 1) / std::sqrt(c(0, 0) * c(1, 1));
  estimate.budget.clear();
  for (const auto& cause : step.causes) {
    estimate.budget.push_back(
        {cause.name, s * std::sqrt(cause.covariance(0, 0)), std::sqrt(cause.covariance(1, 1))});
  }
  estimate.scale =
      normal_quantity(step.to.scale, c.rows() > 2 ? std::sqrt(c(2, 2)) * step.to.scale : 0.0);
}

bool is_better(const Estimate& one, const Estimate& other) {
  const Quantity &s = one.sigma_s_prime_per_mm, &t = other.sigma_s_prime_per_mm;
  return s.std * t.value < t.std * s.value;
}

void report_shots(const TransportRound& round, const MaterialChannel& channel,
                  ChannelResult& result) {
  const std::vector<std::size_t> shots = round.shots();
  const std::vector<ScatteringEquation::Step> steps = round.steps_of_shots();
  for (std::size_t i = 0; i < shots.size(); ++i) {
    ShotResult& single = result.singles.emplace_back();
    single.file = channel.shots[shots[i]]->stated->file;
    single.estimate.rows = round.rows_of_shot(i);
    report_step(steps[i], single.estimate);
  }
  if (steps.size() < 2) return;
  result.agreement = round.agreement(steps);
  widen_by_disagreement(result.agreement, result.estimate);
}

void add_refusals(const LackOfFit& misfit, double unexplained, std::vector<PriorPull> pulls,
                  const ScatteringEquation::ScaleTest& scale, int blocks, Estimate& estimate) {
  if (blocks < kLeastBlocks) {
    estimate.reasons.push_back(fmt::format(
        "the time was too short: {} blocks of paths for each light, at least {} are needed", blocks,
        kLeastBlocks));
  }
  estimate.pulls = std::move(pulls);
  if (const PriorPull* worst = contradiction(estimate.pulls, kMostPull, kLeastPullImage)) {
    estimate.reasons.push_back(contradiction_sentence(*worst, estimate.pulls));
  }
  estimate.misfit_relative = misfit.rms;
  estimate.misfit_p_value = misfit.p_value;
  if (misfit.p_value < kMisfitPValue && misfit.rms > kMisfit) {
    estimate.reasons.push_back(fmt::format(
        "transport does not explain the shots: parts of the image are {:.2g} % off (scale, light, "
        "pose, shape or eta are not as the rig states)",
        100.0 * misfit.rms));
  }
  if (unexplained > kUnexplained) {
    estimate.reasons.push_back(
        fmt::format("transport does not explain the shots: the residual is {:.2g} %, and noise and "
                    "Monte Carlo errors leave {:.2g} % unexplained",
                    100.0 * estimate.rms_relative, 100.0 * unexplained));
  }
  if (scale.p_value < kRefusedScalePValue && std::abs(scale.offset) > kRefusedScale) {
    estimate.reasons.push_back(fmt::format(
        "the shots contradict the scale that the rig states: it should be at least "
        "{:.2g} +- {:.1g} % {} (or light, pose, shape or eta are not as the rig states)",
        100.0 * std::abs(std::expm1(scale.offset)), 100.0 * scale.std,
        scale.offset > 0.0 ? "larger" : "smaller"));
  }
}

void refuse_noisy(double rest_relative, Estimate& estimate) {
  constexpr double kNoisiest = 0.3;
  if (!(rest_relative > kNoisiest)) return;
  estimate.reasons.push_back(
      fmt::format("the paths of transport are too noisy to judge these shots: the residual is "
                  "{:.0f} %; use a larger --time-limit, or a channel in which the material absorbs "
                  "less",
                  100.0 * rest_relative));
}

void refuse_unresolved(const std::vector<double>& area_mm2, Estimate& estimate) {
  constexpr double kOfPatch = 0.1;
  const double sigma_a = estimate.sigma_a_per_mm.value;
  const double sigma_t = estimate.sigma_s_prime_per_mm.value + sigma_a;
  const double reach_mm = 1.0 / std::sqrt(3.0 * sigma_a * sigma_t);
  const double patch_mm = std::sqrt(upper_median(area_mm2));
  if (reach_mm >= kOfPatch * patch_mm) return;
  estimate.reasons.push_back(
      fmt::format("the light dies off within {:.2g} mm, a small part of a patch of {:.2g} mm: the "
                  "shots tell little more than the ratio of sigma_a and sigma_s'",
                  reach_mm, patch_mm));
}

std::vector<Eigen::Index> outlying_rows(const TransportRound& round,
                                        const std::vector<double>& area_mm2) {
  constexpr double kFar = 8.0;  // robust deviations
  const Eigen::VectorXd rest = round.equation().without_nuisances(round.residual());
  return outliers(rest, Eigen::VectorXd::Zero(rest.size()),
                  round.row_variance(area_mm2, round.scatter()).cwiseSqrt(), {.outlier_std = kFar});
}

void report_fit(const TransportRound& round, const DenseSystem& system, const ScalePrior& scale,
                const Eigen::VectorXd& variance, ChannelResult& result) {
  Estimate& estimate = result.estimate;
  estimate.reasons.clear();
  const ScatteringEquation::ScaleTest scale_test = round.scale_test();
  report_step(widened_by_scale(round.equation(), scale_test, round.step()), estimate);
  const Eigen::VectorXd rest = round.residual();
  if (!scale.is_free()) {
    const double settled = std::exp(round.equation().settled_log_scale(rest));
    estimate.scale = normal_quantity(settled, settled * scale.relative_std);
  }
  const Eigen::VectorXd settled_rest = round.equation().without_nuisances(rest);
  report_residual(system, rest, settled_rest, variance, estimate);
  ModelJudgement judgement = round.judgement();
  add_refusals(round.misfit(), round.unexplained(), std::move(judgement.pulls), scale_test,
               round.blocks(), estimate);
  refuse_noisy(settled_rest.norm() / system.l.norm(), estimate);
  result.evidence = std::move(judgement.evidence);
}

}  // namespace scattermeter
