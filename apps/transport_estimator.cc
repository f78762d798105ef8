// --model transport: the medium whose image by volume Monte Carlo is the observed one.
//
// An estimating equation (core/scattering_equation.h) is solved by Newton steps that start from the
// dipole's answer; every step draws new paths, twice as many as it closes in, until those of the
// last step serve the root as well. Z and the weights are the dipole's at the place, which no
// path's noise moves. A 20 mm cube under two LEDs, shots rendered with 10^6 paths a light and
// channel, 30 s on one core a channel: 2.194 +- 0.006 / 0.00202 +- 0.00003 per mm for 2.19 / 0.002
// and 0.4999 +- 0.0006 / 0.01003 +- 0.00002 for 0.5 / 0.01, the rendering's own noise not counted;
// the dipole: 2.086 / 0.00014 and 0.473 / 0.0029. With Z of a pilot simulation's noisy derivatives,
// the deviation of the first was four times as large.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/SparseCore>
#include <fmt/core.h>

#include "apps/estimation_task.h"
#include "apps/model_choice.h"
#include "apps/progress.h"
#include "apps/rig_probes.h"
#include "apps/task_simulation.h"
#include "core/dipole_curve.h"
#include "core/excess_scatter.h"
#include "core/lack_of_fit.h"
#include "core/residual.h"
#include "core/row_selection.h"
#include "core/scattering_equation.h"
#include "core/shot_agreement.h"

namespace scattermeter::apps {
namespace {

// Of the time for all, what rows err by with this many blocks.
constexpr double kFinalBlocks = 512.0;
constexpr std::size_t kLeastRows = 20;
// Parts of a shot whose whole light is compared: at most 2^4, of this many patches at least.
constexpr int kCellLevels = 4;
constexpr int kCellRows = 12;
// A misfit so improbable and so large that the answer is refused.
constexpr double kMisfitPValue = 1e-6;
constexpr double kMisfit = 0.01;
// Rows farther off than this many robust deviations are dust and scratches. Renderings by Monte
// Carlo have longer tails than the noise of a camera.
constexpr double kOutlierStd = 8.0;

const Eigen::MatrixXd& covariance_by(const ScatteringEquation::Step& step,
                                     const std::string& cause) {
  return std::find_if(step.causes.begin(), step.causes.end(),
                      [&](const auto& c) { return c.name == cause; })
      ->covariance;
}

// A material in a channel, on the way to its medium.
class TransportFit {
 public:
  TransportFit(const Rig& rig, const RigProbes& probes, const Task& task, DipoleSystem dipole,
               const ScalePrior& scale, const MeasureOptions& options)
      : task_(task),
        knots_(dipole.knots),
        system_(std::move(dipole.system)),
        rows_(std::move(dipole.rows)),
        scale_(scale),
        options_(options),
        simulation_(rig, probes, task) {
    // The image is that of whole patches.
    keep([&](std::size_t shot, std::size_t row, Eigen::Index) {
      return task_.shots[shot]->seen->map.guarded_of_row[row] == 0 ? RowState::kUsed
                                                                   : RowState::kEdge;
    });
  }

  // Starts from the result's estimate and replaces it.
  void run(ChannelResult& result) {
    Estimate& estimate = result.estimate;
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    ScatteringPoint at{estimate.sigma_s_prime_per_mm.value, estimate.sigma_a_per_mm.value,
                       estimate.scale.value};
    result.singles.clear();
    result.agreement = {};
    estimate.converged = false;
    estimate.rows = static_cast<std::size_t>(system_.l.size());
    if (estimate.rows < kLeastRows) {
      refuse(result, fmt::format("only {} whole patches can be used, at least {} are needed",
                                 estimate.rows, kLeastRows));
      return;
    }
    int blocks = 8;  // per light and view; more as the search closes in
    TaskSimulation::Draw first = simulation_.draw(Eigen::MatrixXd::Zero(0, system_.l.size()));
    simulation_.trace(first, at, blocks);
    ScatteringImage noisy = simulation_.image(first);
    double traced = blocks;
    bool outliers_known = false;
    constexpr int kRounds = 30;
    for (int round = 0; round < kRounds && seconds() < options_.time_limit_s; ++round) {
      Round r(*this, noisy, at, traced / kFinalBlocks);
      const double started_s = seconds();
      TaskSimulation::Draw draw = simulation_.draw(r.projection());
      simulation_.trace(draw, at, blocks);
      r.take(draw);
      // Close enough for the paths drawn here to serve the root as well: as many as matter.
      while (near(r.step) && !(fine(r.step, at) && draw.blocks() >= kLeastBlocks)) {
        const int so_far = draw.blocks();
        const double per_block_s = (seconds() - started_s) / so_far;
        const int affordable = static_cast<int>((options_.time_limit_s - seconds()) / per_block_s);
        if (affordable < so_far / 8 + 1) break;
        simulation_.trace(draw, at, std::min(so_far, affordable));
        r.take(draw);
      }
      noisy = r.image;
      traced = draw.blocks();
      if (near(r.step)) {
        const ScatteringPoint to = r.step.to;
        if (!outliers_known && leave_outliers_out(r)) {
          outliers_known = true;
          at = to;
          noisy = simulation_.image(draw);
          continue;
        }
        report(r, result);
        return;
      }
      if (r.step.change < 4.0 * std::sqrt(covariance_by(r.step, "Monte Carlo").maxCoeff()) ||
          r.step.change < 0.2) {
        blocks *= 2;
      }
      at = r.step.to;
    }
    refuse(result, "the search for the medium by transport did not converge in time");
  }

 private:
  static constexpr int kLeastBlocks = 64;  // for covariances of a shot's parts

  // Shots with rows enough for an answer of their own.
  struct Single {
    std::size_t shot;
    Eigen::Index first;  // row
    DenseSystem system;
    std::optional<ScatteringEquation> equation;
  };

  // One place of the search: equations for all shots and for each alone, and what paths drawn for
  // them say.
  struct Round {
    const TransportFit& fit;
    ScatteringPoint at;
    ScatteringImage pilot;
    ScatteringEquation joint;
    std::vector<Single> singles;
    ScatteringImage image;
    Eigen::MatrixXd covariance;  // of projection() * image
    // Over the Monte Carlo variance, what shots err by beyond their noise: among the rows, and in
    // all.
    double scatter_of_rows = 1;
    double scatter = 1;
    ScatteringEquation::Step step;
    int blocks = 0;

    Round(const TransportFit& f, const ScatteringImage& noisy, const ScatteringPoint& place,
          double monte_carlo)
        : fit(f),
          at(place),
          pilot(f.smooth_pilot(noisy, place)),
          joint(f.system_, f.scale_, pilot, place, monte_carlo) {
      const std::vector<Eigen::Index>& shot_rows = f.system_.shot_rows;
      Eigen::Index first = 0;
      for (std::size_t s = 0; s < shot_rows.size() && shot_rows.size() > 1; ++s) {
        if (shot_rows[s] >= static_cast<Eigen::Index>(kLeastRows))
          singles.push_back({s, first, {}, {}});
        first += shot_rows[s];
      }
      for (Single& single : singles) {
        std::vector<Eigen::Index> rows(static_cast<std::size_t>(shot_rows[single.shot]));
        std::iota(rows.begin(), rows.end(), single.first);
        single.system = selected(f.system_, rows);
        single.equation.emplace(single.system, f.scale_, part(pilot, single), place, monte_carlo);
      }
    }
    // The equations hold on to what stands beside them.
    Round(const Round&) = delete;
    Round& operator=(const Round&) = delete;

    static ScatteringImage part(const ScatteringImage& m, const Single& single) {
      const Eigen::Index n = single.system.l.size();
      return {m.l.segment(single.first, n), m.per_log_sigma_s.segment(single.first, n),
              m.per_sigma_a.segment(single.first, n), m.variance.segment(single.first, n)};
    }

    Eigen::Index unknowns() const { return joint.projection().rows(); }
    Eigen::Index first_cell() const {
      return unknowns() * (1 + static_cast<Eigen::Index>(singles.size()));
    }

    // Of the joint answer, of each shot's own, and of the light of the shots' parts.
    Eigen::MatrixXd projection() const {
      Eigen::MatrixXd all =
          Eigen::MatrixXd::Zero(first_cell() + fit.cells_.rows(), fit.system_.l.size());
      all.topRows(unknowns()) = joint.projection();
      for (std::size_t i = 0; i < singles.size(); ++i) {
        const Eigen::MatrixXd& own = singles[i].equation->projection();
        all.block(static_cast<Eigen::Index>(i + 1) * unknowns(), singles[i].first, unknowns(),
                  own.cols()) = own;
      }
      all.bottomRows(fit.cells_.rows()) = fit.cells_;
      return all;
    }

    void take(const TaskSimulation::Draw& draw) {
      image = fit.simulation_.image(draw);
      covariance = TaskSimulation::covariance(draw);
      blocks = draw.blocks();
      const Eigen::MatrixXd own = covariance.topLeftCorner(unknowns(), unknowns());
      step = joint.step(image, own, at);
      scatter_of_rows =
          excess_scatter(joint.without_nuisances(joint.residual(image, at, step.to)),
                         fit.system_.std_l.cwiseAbs2(), at.scale * at.scale * image.variance,
                         joint.row_variance().cwiseInverse());
      scatter = scatter_of_rows;
      // What has been smoothed, as renderings are, scatters less from row to row than from part to
      // part.
      for (int i = 0; blocks >= kLeastBlocks && i < 4; ++i) {
        const LackOfFit parts = misfit(scatter);
        if (parts.dof > 0.0) scatter = std::max(scatter_of_rows, scatter * parts.chi2 / parts.dof);
      }
      step = joint.step(image, own, at, scatter);
    }

    ScatteringEquation::Step step_of(std::size_t i) const {
      const Eigen::Index first = static_cast<Eigen::Index>(i + 1) * unknowns();
      return singles[i].equation->step(part(image, singles[i]),
                                       covariance.block(first, first, unknowns(), unknowns()), at,
                                       scatter);
    }

    // Between the answers of all shots, from what they share.
    ShotAgreement agreement(const std::vector<ScatteringEquation::Step>& steps) const {
      const auto n = static_cast<Eigen::Index>(steps.size());
      Eigen::VectorXd answers(2 * n);
      Eigen::MatrixXd all(2 * n, 2 * n);
      for (Eigen::Index i = 0; i < n; ++i) {
        const auto& a = steps[static_cast<std::size_t>(i)];
        answers.segment<2>(2 * i) = a.move.head<2>();
        all.block<2, 2>(2 * i, 2 * i) = a.covariance.topLeftCorner<2, 2>();
        for (Eigen::Index k = 0; k < i; ++k) {
          const auto& b = steps[static_cast<std::size_t>(k)];
          // Shots under the same light share paths.
          const Eigen::MatrixXd paths =
              at.scale * at.scale *
              covariance.block((i + 1) * unknowns(), (k + 1) * unknowns(), unknowns(), unknowns());
          const Eigen::MatrixXd shared =
              a.pushes * b.pushes.transpose() + a.inverse * paths * b.inverse.transpose();
          all.block<2, 2>(2 * i, 2 * k) = shared.topLeftCorner<2, 2>();
          all.block<2, 2>(2 * k, 2 * i) = shared.topLeftCorner<2, 2>().transpose();
        }
      }
      return agreement_of(answers, all);
    }

    // Of the light of the shots' parts, with free coefficients.
    LackOfFit misfit(double expected_scatter) const {
      const Eigen::Index n = fit.cells_.rows();
      const Eigen::VectorXd rest = fit.cells_ * joint.residual(image, at, step.to);
      const Eigen::MatrixXd noise =
          fit.cells_ * fit.system_.std_l.cwiseAbs2().asDiagonal() * fit.cells_.transpose();
      // The inverse of a covariance from so many blocks is too large in the mean (Hartlap,
      // Simon & Schneider 2007); cells of other shots do not count.
      const double cells = std::pow(2.0, kCellLevels);
      const double too_large = (blocks - 1.0) / (blocks - cells - 2.0);
      const Eigen::MatrixXd paths =
          at.scale * at.scale * expected_scatter * too_large * covariance.bottomRightCorner(n, n);
      const Eigen::MatrixXd j =
          fit.cells_ * ScatteringEquation::jacobian(pilot, at, unknowns() == 3);
      Eigen::MatrixXd free(n, j.cols() + joint.nuisances().cols());
      constexpr double kWide = 30.0;  // of the light
      for (Eigen::Index k = 0; k < j.cols(); ++k) {
        free.col(k) = kWide / j.col(k).cwiseAbs().maxCoeff() * j.col(k);
      }
      free.rightCols(joint.nuisances().cols()) = fit.cells_ * joint.nuisances();
      const auto unbound = std::count_if(fit.system_.nuisances.begin(), fit.system_.nuisances.end(),
                                         [](const Nuisance& v) { return !std::isfinite(v.std); });
      const int fitted = static_cast<int>(j.cols() + unbound);
      if (n <= fitted) return {};
      return lack_of_fit(rest, noise + paths, free, fitted);
    }
  };

  static void refuse(ChannelResult& result, const std::string& reason) {
    result.estimate.reasons = {reason};
  }

  // Rows of which `state_of(shot, row of its view, row of the system so far)` is kUsed.
  template <class StateOf>
  void keep(const StateOf& state_of) {
    std::vector<Eigen::Index> kept;
    Eigen::Index at = 0;
    for (std::size_t s = 0; s < rows_.size(); ++s) {
      for (std::size_t j = 0; j < rows_[s].state.size(); ++j) {
        if (rows_[s].state[j] != RowState::kUsed) continue;
        const RowState state = state_of(s, j, at);
        if (state == RowState::kUsed) {
          kept.push_back(at);
        } else {
          leave_out(rows_[s], j, state);
        }
        ++at;
      }
    }
    system_ = selected(system_, kept);
    simulation_.set_rows(rows_);
    divide();
  }

  // Weights of the rows in the light of parts of the shots, relative to what is observed of it.
  void divide() {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::Index first = 0;
    Eigen::Index n_cells = 0;
    for (const Eigen::Index n : system_.shot_rows) {
      const auto begin = simulation_.center_mm().begin() + first;
      const std::vector<int> cell = residual_cells({begin, begin + n}, kCellLevels, kCellRows);
      Eigen::Index most = -1;
      for (Eigen::Index j = 0; j < n; ++j) {
        const auto row = static_cast<std::size_t>(first + j);
        const Eigen::Index own = cell[static_cast<std::size_t>(j)];
        entries.emplace_back(n_cells + own, first + j, simulation_.area_mm2()[row]);
        most = std::max(most, own);
      }
      n_cells += most + 1;
      first += n;
    }
    Eigen::SparseMatrix<double> weights(n_cells, system_.l.size());
    weights.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd light = weights * system_.l;
    cells_ = light.cwiseInverse().asDiagonal() * Eigen::MatrixXd(weights);
  }

  bool leave_outliers_out(const Round& r) {
    const Eigen::VectorXd rest =
        r.joint.without_nuisances(r.joint.residual(r.image, r.at, r.step.to));
    const Eigen::VectorXd std = (system_.std_l.cwiseAbs2() + r.scatter * r.at.scale * r.at.scale *
                                                                 smooth_variance(r.pilot, r.image))
                                    .cwiseSqrt();
    RowSelectionOptions options;
    options.outlier_std = kOutlierStd;
    const std::vector<Eigen::Index> far =
        outliers(rest, Eigen::VectorXd::Zero(rest.size()), std, options);
    if (far.empty()) return false;
    keep([&](std::size_t, std::size_t, Eigen::Index row) {
      return std::binary_search(far.begin(), far.end(), row) ? RowState::kOutlier : RowState::kUsed;
    });
    return true;
  }

  // Monte Carlo variances as light and area would have them, on the whole as large as those of
  // `noisy`: weights must not follow the noise of paths.
  Eigen::VectorXd smooth_variance(const ScatteringImage& pilot,
                                  const ScatteringImage& noisy) const {
    const Eigen::Map<const Eigen::VectorXd> area(simulation_.area_mm2().data(), pilot.l.size());
    const Eigen::VectorXd share = pilot.l.cwiseMax(0.0).cwiseQuotient(area);
    return share * (noisy.variance.sum() / share.sum());
  }

  // The dipole's image and derivatives.
  ScatteringImage smooth_pilot(const ScatteringImage& noisy, const ScatteringPoint& at) const {
    const double sigma_t = at.sigma_s_per_mm + at.sigma_a_per_mm;
    const double albedo = at.sigma_s_per_mm / sigma_t;
    const DipoleCurve curve = dipole_curve(knots_, std::log(sigma_t), 1.0 - albedo, task_.eta);
    ScatteringImage out;
    out.l = system_.weights * curve.r;
    const Eigen::VectorXd d_u = system_.weights * curve.d_u;
    const Eigen::VectorXd d_q = system_.weights * curve.d_q;
    out.per_log_sigma_s = albedo * d_u - albedo * (1.0 - albedo) * d_q;
    out.per_sigma_a = (d_u + albedo * d_q) / sigma_t;
    out.variance = smooth_variance(out, noisy);
    return out;
  }

  // A step so short that what is not linear in it is small against the Monte Carlo error, or small.
  static bool near(const ScatteringEquation::Step& step) {
    constexpr double kNear = 0.03;
    constexpr double kFar = 0.1;
    return step.change <
           std::clamp(3.0 * std::sqrt(covariance_by(step, "Monte Carlo")(0, 0)), kNear, kFar);
  }

  // Monte Carlo is small against the rest, or against what anyone asks for.
  static bool fine(const ScatteringEquation::Step& step, const ScatteringPoint& at) {
    constexpr double kOfRest = 0.1;  // of the variance
    constexpr double kFloor[2] = {1e-3, 5e-3};
    const double unit[2] = {1.0, std::max(at.sigma_a_per_mm, 1e-3)};
    for (Eigen::Index k = 0; k < 2; ++k) {
      const double own = covariance_by(step, "Monte Carlo")(k, k);
      const double rest = step.covariance(k, k) - own;
      const double floor = kFloor[k] * unit[k];
      if (own > kOfRest * rest && own > floor * floor) return false;
    }
    return true;
  }

  static void tell(const ScatteringEquation::Step& step, Estimate& e) {
    const double s = step.to.sigma_s_per_mm;
    const Eigen::MatrixXd& c = step.covariance;
    e.converged = true;
    e.sigma_s_prime_per_mm = normal_quantity(s, s * std::sqrt(c(0, 0)));
    e.sigma_a_per_mm = normal_quantity(step.to.sigma_a_per_mm, std::sqrt(c(1, 1)));
    e.correlation = c(0, 1) / std::sqrt(c(0, 0) * c(1, 1));
    e.budget.clear();
    for (const auto& cause : step.causes) {
      e.budget.push_back(
          {cause.name, s * std::sqrt(cause.covariance(0, 0)), std::sqrt(cause.covariance(1, 1))});
    }
    e.scale =
        normal_quantity(step.to.scale, c.rows() > 2 ? std::sqrt(c(2, 2)) * step.to.scale : 0.0);
  }

  void report(const Round& r, ChannelResult& result) const {
    Estimate& e = result.estimate;
    e.reasons.clear();
    tell(r.step, e);
    const Eigen::VectorXd rest = r.joint.residual(r.image, r.at, r.step.to);
    const Eigen::VectorXd own = r.joint.without_nuisances(rest);
    const Eigen::VectorXd variance =
        system_.std_l.cwiseAbs2() + r.at.scale * r.at.scale * smooth_variance(r.pilot, r.image);
    e.reduced_chi2 = own.cwiseAbs2().cwiseQuotient(variance).mean();
    const Residual whole = residual(system_.l, system_.l - rest, system_.std_l);
    e.rms_relative = whole.rms_relative;
    e.psnr_db = whole.psnr_db;
    report_rows(task_, rows_, result);
    if (r.blocks < kLeastBlocks) {
      e.reasons.push_back(
          fmt::format("the time was too short: {} blocks of paths for each light, at "
                      "least {} are needed",
                      r.blocks, kLeastBlocks));
    }
    judge(r, e);
    std::vector<ScatteringEquation::Step> steps;
    for (std::size_t i = 0; i < r.singles.size(); ++i) {
      steps.push_back(r.step_of(i));
      ShotResult& single = result.singles.emplace_back();
      single.file = task_.shots[r.singles[i].shot]->rig->file;
      single.estimate.rows = static_cast<std::size_t>(r.singles[i].system.l.size());
      tell(steps.back(), single.estimate);
    }
    if (steps.size() < 2) return;
    result.agreement = r.agreement(steps);
    widen_by_disagreement(result.agreement, e);
  }

  static void judge(const Round& r, Estimate& e) {
    if (r.blocks >= kLeastBlocks) {
      const LackOfFit misfit = r.misfit(r.scatter_of_rows);
      e.misfit_relative = misfit.rms;
      e.misfit_p_value = misfit.p_value;
      if (misfit.p_value < kMisfitPValue && misfit.rms > kMisfit) {
        e.reasons.push_back(fmt::format(
            "transport does not explain the shots: parts of the image are {:.2g} % off (scale, "
            "light, pose, shape or eta are not what the rig says)",
            100.0 * misfit.rms));
      }
    }
    constexpr double kUndetermined = 0.5;
    const double relative = e.sigma_s_prime_per_mm.std / e.sigma_s_prime_per_mm.value;
    if (!std::isfinite(relative) || relative > kUndetermined) {
      e.reasons.push_back("these shots do not determine sigma_s'");
    }
    if (!std::isfinite(e.sigma_a_per_mm.std)) {
      e.reasons.push_back("these shots set no upper limit to sigma_a");
    }
  }

  const Task& task_;
  DistanceKnots knots_;
  DenseSystem system_;
  TaskRows rows_;
  ScalePrior scale_;
  const MeasureOptions& options_;
  TaskSimulation simulation_;
  Eigen::MatrixXd cells_;  // parts of shots x rows: relative light
};

}  // namespace

void estimate_transport(Estimation& e) {
  std::vector<std::optional<DipoleSystem>> systems(e.tasks.size());
  estimate_dipole(e, &systems);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < e.tasks.size(); ++i) {
    if (!systems[i]) continue;
    e.results[i].why_transport = why_transport(e.results[i], systems[i]->system);
    if (e.options.model == Model::kTransport || !e.results[i].why_transport.empty()) {
      wanted.push_back(i);
    }
  }
  if (wanted.empty()) return;
  const RigProbes probes = open_probes(e.rig);
  Progress progress("transport", static_cast<int>(wanted.size()), e.options.quiet);
  for (const std::size_t i : wanted) {
    ChannelResult& result = e.results[i];
    result.model = Model::kTransport;
    result.dipole = result.estimate;
    result.recovered.reset();
    result.misfit.reset();
    TransportFit(e.rig, probes, e.tasks[i], std::move(*systems[i]), scale_prior(e.rig), e.options)
        .run(result);
    progress.step();
  }
  e.watch.lap("transport");
}

}  // namespace scattermeter::apps
