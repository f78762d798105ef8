// --model transport: the medium whose image by volume Monte Carlo is the observed one.
//
// An estimating equation (core/fit/scattering_equation.h) is solved by Newton steps that start from
// the dipole's answer; every step draws new paths, more as it closes in, until those of the last
// step serve the root as well. Z is the dipole's, set right part by part by what earlier paths have
// shown (core/fit/part_light.h), and the weights know how the light of cells errs together. What
// shots err by beyond their noise widens the answer as if it came from paths, and parts that are
// off as wholes refuse it.
//
// Cube and pyramid under two LEDs (four shots, eta 1.3), exact scale, 60 s on two cores a channel,
// per mm. 2.19 / 0.002, three truths of 1.2 10^7 paths a light: 2.193, 2.194, 2.192 (each +- 0.005)
// / 0.00203, 0.00203, 0.00198 (each +- 0.00004). Truths of 4 10^6: 1.003 +- 0.002 / 0.00503 +-
// 0.00003 for 1.0 / 0.005 and 0.5004 +- 0.0009 / 0.00999 +- 0.00004 for 0.5 / 0.01. The dipole's
// best: 2.19 / 0.0003, 0.96 / 0.0018, 0.46 / 0.0031. With a scale known to 2 %: 2.186 +- 0.014 /
// 0.0021 +- 0.0002, 0.993 +- 0.006 / 0.0052 +- 0.0002, 0.496 +- 0.002 / 0.0102 +- 0.0002. With the
// dipole's Z as it is and weights of independent rows, the second of these had 2.7 times the
// deviation and the third 6 times.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/base/progress.h"
#include "core/diffusion/dipole_curve.h"
#include "core/estimation/channel_simulation.h"
#include "core/estimation/estimation.h"
#include "core/estimation/model_choice.h"
#include "core/estimation/transport_round.h"
#include "core/estimation/transport_verdict.h"
#include "core/fit/part_light.h"
#include "core/fit/residual.h"
#include "core/view/row_selection.h"

namespace scattermeter {
namespace {

constexpr int kFirstBlocks = 8;
// Paths that the pilot must have followed before a round may be the last.
constexpr double kLearnedBlocks = 32.0;
// Rows farther off than this many robust deviations are dust and scratches. Renderings by Monte
// Carlo have longer tails than the noise of a camera.
constexpr double kOutlierStd = 8.0;

// A material in a channel, on the way to its medium.
class TransportFit {
 public:
  TransportFit(const Scene& scene, const MaterialChannel& task, const DipoleSystem& dipole,
               const ScalePrior& scale, const EstimateOptions& options, const ProgressStage& stage)
      : task_(task),
        knots_(dipole.knots),
        system_(dipole.system()),
        rows_(*dipole.rows),
        scale_(scale),
        options_(options),
        stage_(stage),
        simulation_(scene, task) {
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
    const bool free_scale = !std::isfinite(scale_.relative_std);
    ScatteringPoint at{estimate.sigma_s_prime_per_mm.value, estimate.sigma_a_per_mm.value,
                       free_scale ? estimate.scale.value : 1.0};
    result.singles.clear();
    result.agreement = {};
    estimate.converged = false;
    estimate.rows = static_cast<std::size_t>(system_.l.size());
    if (system_.l.size() < TransportRound::kLeastRows) {
      estimate.reasons = {fmt::format("only {} whole patches can be used, at least {} are needed",
                                      estimate.rows, TransportRound::kLeastRows)};
      return;
    }
    int blocks = kFirstBlocks;  // per light and view; more as the search closes in
    Look last = first_look(at);
    bool outliers_known = false;
    constexpr int kRounds = 30;
    for (int round = 0; round < kRounds && seconds() < options_.time_limit_s; ++round) {
      stage_.check();
      const bool learned = part_light_.blocks() >= kLearnedBlocks;
      // On the way, a scale known to a deviation is taken as exact: the search is steadier.
      TransportRound r({system_, parts_, simulation_},
                       learned || free_scale ? scale_ : ScalePrior{}, at, pilot(last.image, at),
                       last.blocks / kFinalPathBlocks + last.scatter - 1.0,
                       (1.0 / kFinalPathBlocks + (last.scatter - 1.0) / last.blocks) *
                           part_light_.cells_alike(parts_));
      const double started_s = seconds();
      ChannelSimulation::Draw draw = simulation_.draw(r.projection());
      simulation_.trace(draw, at, blocks);
      r.take(draw);
      // Close enough for the paths drawn here to serve the root as well: as many as matter.
      while (learned && near(r) && !fine(r)) {
        stage_.check();
        const double per_block_s = (seconds() - started_s) / r.blocks();
        const int affordable = static_cast<int>((options_.time_limit_s - seconds()) / per_block_s);
        const int left = static_cast<int>(std::min<std::int64_t>(
            options_.paths / PathOptions{}.paths_per_block - r.blocks(), r.blocks()));
        if (left < 1 || affordable < r.blocks() / 8 + 1) break;
        simulation_.trace(draw, at, std::min(left, affordable));
        r.take(draw);
      }
      // What a far place has shown is not what holds here.
      constexpr double kFarStep = 0.3;
      if (r.step().change > kFarStep) part_light_.forget();
      last = {r.image(), r.blocks(), r.scatter()};
      part_light_.learn(parts_, r.image(), r.cell_covariance(), dipole(at), r.blocks());
      const ScatteringPoint to = r.step().to;
      if (learned && near(r)) {
        if (outliers_known || !leave_outliers_out(r)) return report(r, result);
        outliers_known = true;
        last = first_look(to);
      } else if (r.step().change < 0.2 || r.scatter_within() > 1.5) {
        // Where the paths' noise decides how far the step goes, more of them.
        blocks *= 2;
      }
      at = to;
    }
    estimate.reasons = {"the search for the medium by transport did not converge in time"};
  }

 private:
  // What paths drawn elsewhere say of the errors to come.
  struct Look {
    ScatteringImage image;
    int blocks = 0;
    double scatter = 1;
  };

  Look first_look(const ScatteringPoint& at) {
    ChannelSimulation::Draw draw = simulation_.draw(parts_.cells());
    simulation_.trace(draw, at, kFirstBlocks);
    const Look look{simulation_.image(draw), kFirstBlocks, 1.0};
    part_light_.learn(parts_, look.image, ChannelSimulation::covariance(draw), dipole(at),
                      kFirstBlocks);
    return look;
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
    parts_ =
        ShotParts(system_.shot_rows, simulation_.center_mm(), simulation_.area_mm2(), system_.l);
    part_light_.forget();
  }

  bool leave_outliers_out(const TransportRound& r) {
    const Eigen::VectorXd rest = r.equation().without_nuisances(r.residual());
    const Eigen::VectorXd std =
        (system_.std_l.cwiseAbs2() +
         r.scatter() * r.at().scale * r.at().scale * smooth_variance(r.pilot().l, r.image()))
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
  Eigen::VectorXd smooth_variance(const Eigen::VectorXd& l, const ScatteringImage& noisy) const {
    const Eigen::Map<const Eigen::VectorXd> area(simulation_.area_mm2().data(), l.size());
    const Eigen::VectorXd share = l.cwiseMax(0.0).cwiseQuotient(area);
    return share * (noisy.variance.sum() / share.sum());
  }

  ScatteringImage dipole(const ScatteringPoint& at) const {
    const double sigma_t = at.sigma_s_per_mm + at.sigma_a_per_mm;
    const double albedo = at.sigma_s_per_mm / sigma_t;
    const DipoleCurve curve =
        dipole_curve(knots_, std::log(sigma_t), 1.0 - albedo, task_.eta_int_over_ext);
    ScatteringImage out;
    out.l = system_.weights * curve.r;
    const Eigen::VectorXd d_u = system_.weights * curve.d_u;
    const Eigen::VectorXd d_q = system_.weights * curve.d_q;
    out.per_log_sigma_s = albedo * d_u - albedo * (1.0 - albedo) * d_q;
    out.per_sigma_a = (d_u + albedo * d_q) / sigma_t;
    return out;
  }

  // The dipole's image and derivatives, set right part by part.
  ScatteringImage pilot(const ScatteringImage& noisy, const ScatteringPoint& at) const {
    ScatteringImage out = dipole(at);
    if (part_light_.blocks() >= kLearnedBlocks) part_light_.correct(parts_, out);
    out.variance = smooth_variance(out.l, noisy);
    return out;
  }

  void report(const TransportRound& r, ChannelResult& result) const {
    Estimate& e = result.estimate;
    e.reasons.clear();
    tell(doubted(r), e);
    const Eigen::VectorXd rest = r.residual();
    if (std::isfinite(scale_.relative_std)) {
      const double scale = std::exp(r.equation().settled_log_scale(rest));
      e.scale = normal_quantity(scale, scale * scale_.relative_std);
    }
    const Eigen::VectorXd variance =
        system_.std_l.cwiseAbs2() +
        r.at().scale * r.at().scale * smooth_variance(r.pilot().l, r.image());
    e.reduced_chi2 =
        r.equation().without_nuisances(rest).cwiseAbs2().cwiseQuotient(variance).mean();
    const Residual whole = residual(system_.l, system_.l - rest, system_.std_l);
    e.rms_relative = whole.rms_relative;
    e.psnr_db = whole.psnr_db;
    e.rows = static_cast<std::size_t>(system_.l.size());
    report_rows(task_, rows_, result);
    if (options_.keep_rows) {
      result.rows = shot_rows(task_, rows_, system_.l - rest, variance.cwiseSqrt());
    }
    judge(r, e);
    const std::vector<std::size_t> shots = r.shots();
    const std::vector<ScatteringEquation::Step> steps = r.steps_of_shots();
    for (std::size_t i = 0; i < shots.size(); ++i) {
      ShotResult& single = result.singles.emplace_back();
      single.file = task_.shots[shots[i]]->stated->file;
      single.estimate.rows = r.rows_of_shot(i);
      tell(steps[i], single.estimate);
    }
    if (steps.size() < 2) return;
    result.agreement = r.agreement(steps);
    widen_by_disagreement(result.agreement, e);
  }

  const MaterialChannel& task_;
  DistanceKnots knots_;
  DenseSystem system_;
  ChannelRows rows_;
  ScalePrior scale_;
  const EstimateOptions& options_;
  const ProgressStage& stage_;
  ChannelSimulation simulation_;
  ShotParts parts_;
  PartLight part_light_;
};

}  // namespace

namespace {

// The dipole for all channels, then transport for those that `wants_transport` chooses.
template <class Wants>
void estimate_from_dipole(Estimation& e, const char* otherwise, const Wants& wants_transport) {
  std::vector<std::optional<DipoleSystem>> systems(e.channels.size());
  estimate_dipole(e, &systems);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < e.channels.size(); ++i) {
    e.results[i].model = otherwise;
    if (!systems[i]) continue;
    e.results[i].why_transport = why_transport(e.results[i], systems[i]->image_in_std);
    if (wants_transport(e.results[i])) wanted.push_back(i);
  }
  if (wanted.empty()) return;
  ProgressStage stage(e.progress, "transport", wanted.size());
  for (const std::size_t i : wanted) {
    ChannelResult& result = e.results[i];
    result.model = "transport";
    result.dipole = result.estimate;
    result.rows.clear();
    TransportFit(e.scene, e.channels[i], *systems[i], scale_prior(e.scene), e.options, stage)
        .run(result);
    stage.step();
  }
  e.watch.lap("transport");
}

}  // namespace

void estimate_transport(Estimation& e) {
  estimate_from_dipole(e, "transport", [](const ChannelResult&) { return true; });
}

void estimate_auto(Estimation& e) {
  estimate_from_dipole(e, "dipole",
                       [](const ChannelResult& r) { return !r.why_transport.empty(); });
}

}  // namespace scattermeter
