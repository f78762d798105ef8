#include "core/estimation/transport_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/estimation/channel_simulation.h"
#include "core/estimation/material_channel.h"
#include "core/estimation/medium_nuisances.h"
#include "core/estimation/residual_look.h"
#include "core/estimation/total_reflection.h"
#include "core/estimation/transport_pilot.h"
#include "core/estimation/transport_round.h"
#include "core/estimation/transport_start.h"
#include "core/estimation/transport_verdict.h"
#include "core/fit/cell_step.h"
#include "core/transport/path_budget.h"

namespace scattermeter {
namespace {

constexpr int kFirstBlocks = 8;
constexpr int kMaxRounds = 30;
// Rounds after which every further one has more paths.
constexpr int kPatience = 5;
// Time limits that a search may take which lacks but its last blocks to be judged.
constexpr double kLongest = 1.5;
// Relative change of the image by a step beyond which earlier paths do not apply to the new point.
constexpr double kFarStep = 0.3;
// Weights depend on the point and its look. Where they are far less efficient than they promise,
// those of further rounds may be far better (a cube's deviations: 44 %, 8 % and 14 %): the best of
// so many is reported.
constexpr double kEfficient = 0.1;
constexpr int kMostReports = 4;

class TransportSearch {
 public:
  TransportSearch(const Scene& scene, const MaterialChannel& channel, const DipoleSystem& dipole,
                  TransportAtlas& atlas, bool may_trace, const EstimateOptions& options,
                  const ProgressStage& stage)
      : scene_(scene),
        channel_(channel),
        knots_(dipole.knots),
        system_(system_of_paths(dipole, channel.gamma_std, channel.surface_alpha_std > 0.0)),
        rows_(*dipole.rows),
        scale_(scale_prior(scene)),
        options_(options),
        stage_(stage),
        simulation_(scene, channel, atlas, may_trace),
        medium_(scene, channel, knots_, system_),
        budget_(blocks_of(std::min(options.paths, options.looking_paths.value_or(options.paths))),
                options.time_limit_s) {
    // The image is that of whole patches.
    keep([&](std::size_t shot, std::size_t row, Eigen::Index) {
      return channel_.shots[shot]->seen->map.guarded_of_row[row] == 0 ? RowState::kUsed
                                                                      : RowState::kEdge;
    });
  }

  void run(ChannelResult& result) {
    Estimate& estimate = result.estimate;
    result.singles.clear();
    result.agreement = {};
    result.evidence = {};
    result.look.reset();
    estimate.converged = false;
    if (!has_enough_rows(estimate)) return;
    const ScatteringPoint at = start(estimate);
    leave_out(near_total_reflection(scene_, channel_, rows_,
                                    1.0 / (at.sigma_s_per_mm + at.sigma_a_per_mm)),
              RowState::kEdge);
    if (!has_enough_rows(estimate)) return;
    if (std::optional<ChannelResult> found = search(at, result)) {
      result = std::move(*found);
    } else {
      estimate.reasons = {"transport did not converge in time: check the rig, or allow more time"};
    }
  }

 private:
  struct Look {  // the errors to be expected, by an earlier look
    ScatteringImage image;
    Eigen::VectorXd per_eta;  // of it
    PathErrors errors;
  };

  bool has_enough_rows(Estimate& estimate) const {
    estimate.rows = static_cast<std::size_t>(system_.l.size());
    if (system_.l.size() >= TransportRound::kLeastRows) return true;
    estimate.reasons = {fmt::format("only {} whole patches can be used, at least {} are needed",
                                    estimate.rows, TransportRound::kLeastRows)};
    return false;
  }

  // A report on `before` where the search ends; empty if it does not.
  std::optional<ChannelResult> search(ScatteringPoint at, const ChannelResult& before) {
    std::optional<ChannelResult> found;
    int blocks = kFirstBlocks;  // per light and view; more as the search closes in
    Look last = first_look(at);
    approach(at, last);
    bool outliers_known = false;
    int reports = 0;
    bool is_owed = false;  // a round without the outliers, with the paths that there are
    for (int i = 0; i < kMaxRounds && (budget_.left_s() > 0.0 || is_owed); ++i) {
      stage_.check();
      const bool learned = pilots_.have_learned();
      const std::array<TransportRound::Pilot, 2> pilots = pilots_.pilots(
          parts_, dipole(at), simulation_.area_mm2(), last.image.variance, last.errors.of_block());
      medium_.set_columns(at, scale_.is_free(), simulation_.surfaces(), parts_,
                          mean_of(pilots[0].image, pilots[1].image), last.image.l, last.per_eta,
                          system_);
      // During the search, a scale with a prior is taken as exact: that is more stable.
      TransportRound round({system_, parts_}, learned || scale_.is_free() ? scale_ : ScalePrior{},
                           at, pilots, last.errors.blocks * last.errors.of_block());
      trace(round, blocks, learned, last);
      const PathErrors assumed =
          std::exchange(last, {round.image(), round.look().per_eta, errors(round)}).errors;
      const bool is_weighted = fits_weights(last.errors, assumed);
      if (round.step().change > kFarStep) pilots_.forget();
      pilots_.learn(
          parts_, round.look(),
          {round.of_cells(round.look().by_half[0]), round.of_cells(round.look().by_half[1])},
          dipole(at));
      const ScatteringPoint to = round.step().to;
      if (!std::isfinite(to.sigma_s_per_mm) || !std::isfinite(to.sigma_a_per_mm)) break;
      if (learned && is_close(round.step(), round.blocks(), round.misfit())) {
        is_owed = !outliers_known &&
                  leave_out(outlying_rows(round, simulation_.area_mm2()), RowState::kOutlier);
        if (is_owed) {
          last = first_look(to, round.scatter());
        } else {
          ChannelResult now = before;
          report(round, now);
          if (!found || is_better(now.estimate, found->estimate)) found = std::move(now);
          if (is_weighted && (round.efficiency() > kEfficient || ++reports == kMostReports)) break;
        }
        outliers_known = true;
      } else if (round.step().change < 0.2 || i >= kPatience || is_noise(round.step()) ||
                 (round.step().change < kFarStep && round.scatter_within() > 1.5)) {
        // Noise of the paths dominates the step. With the same paths, steps may lead in a circle.
        blocks = std::max(blocks, next_blocks(to, blocks, budget_));
      }
      at = to;
    }
    return found;
  }

  // Steps by cells, where there are paths already: a look is cheaper than a round.
  void approach(ScatteringPoint& at, Look& last) {
    for (int i = 0; i < 3 && last.errors.blocks >= kLeastBlocks; ++i) {
      const ScatteringEquation::Step step =
          step_by_cells(system_, parts_, scale_, last.image, at, last.errors.scatter);
      if (!std::isfinite(step.change)) return;  // one cell does not tell two unknowns
      at = step.to;
      if (step.change < 0.1) return;  // of the image
      if (step.change > kFarStep) pilots_.forget();
      last = first_look(at);
    }
  }

  ScatteringPoint start(const Estimate& dipole) {
    const auto light = [&](int node, double sigma_a_per_mm) -> Eigen::ArrayXd {
      stage_.check();
      return parts_.of_parts(simulation_.light_at_node(node, sigma_a_per_mm, kFirstBlocks / 2));
    };
    return starting_point(dipole, simulation_.largest_size_mm(), scale_.is_free(), parts_.light(),
                          light);
  }

  ChannelSimulation::Look look(const ScatteringPoint& at, int blocks,
                               const ChannelSimulation::Projections& projections) {
    const double started_s = budget_.elapsed_s();
    const std::int64_t paths = simulation_.missing_paths(at, blocks);
    ChannelSimulation::Look out = simulation_.look(
        at, blocks, projections, [this](const ScatteringPoint& p) { return dipole(p); });
    budget_.count(paths, budget_.elapsed_s() - started_s);
    return out;
  }

  // `blocks` of paths at the round's point; where that is close enough to the root (may_be_last),
  // as many as are useful and as time and options allow. by: the look that made its weights.
  void trace(TransportRound& round, int blocks, bool may_be_last, const Look& by) {
    const ChannelSimulation::Projections projections = round.projections();
    const auto take = [&](int of_blocks) {
      ChannelSimulation::Look seen = look(round.at(), of_blocks, projections);
      medium_.see_eta(round.pilot(), round.at().scale, seen.per_eta, system_);
      round.take(std::move(seen));
    };
    take(blocks);
    while (may_be_last && fits_weights(errors(round), by.errors) &&
           is_close(round.step(), round.blocks(), round.misfit()) && !round.has_enough_paths()) {
      stage_.check();
      int more = next_blocks(round.at(), round.blocks(), budget_);
      if (more == 0 && round.blocks() < kLeastBlocks &&
          budget_.has_time_for(simulation_.missing_paths(round.at(), kLeastBlocks), kLongest)) {
        more = kLeastBlocks;
      }
      if (more == 0) break;
      take(more);
    }
  }

  static double blocks_of(std::int64_t paths) { return paths / ChannelSimulation::kBlockPaths; }
  std::function<std::int64_t(int blocks)> missing(const ScatteringPoint& at) const {
    return [this, at](int blocks) { return simulation_.missing_paths(at, blocks); };
  }
  int next_blocks(const ScatteringPoint& at, int now, const PathBudget& budget) const {
    return budget.next_blocks(now, kLeastBlocks, missing(at));
  }
  int final_blocks(const ScatteringPoint& at, int now) const {
    return budget_.final_blocks(now, kLeastBlocks, kFinalPathBlocks, missing(at));
  }
  PathErrors errors(const TransportRound& round) const {
    return {round.scatter(), round.blocks(), final_blocks(round.at(), round.blocks())};
  }

  Look first_look(const ScatteringPoint& at, std::optional<double> scatter = {}) {
    ChannelSimulation::Look seen = look(at, kFirstBlocks, {parts_.cells(), parts_.cells()});
    pilots_.learn(parts_, seen, seen.by_half, dipole(at));
    PathErrors errors = first_errors(seen.blocks, final_blocks(at, seen.blocks));
    errors.scatter = scatter.value_or(errors.scatter);
    return {std::move(seen.image), std::move(seen.per_eta), errors};
  }

  void keep(const StateOfRow& state_of) {
    const std::vector<Eigen::Index> kept = keep_rows(rows_, state_of);
    system_ = selected(system_, kept);
    simulation_.set_rows(rows_);
    medium_.set_rows(rows_, kept);
    parts_ =
        ShotParts(system_.shot_rows, simulation_.center_mm(), simulation_.area_mm2(), system_.l);
    pilots_.forget();
  }

  // Whether there were any.
  bool leave_out(const std::vector<Eigen::Index>& numbers, RowState state) {
    if (!numbers.empty()) keep(state_at(numbers, state));
    return !numbers.empty();
  }

  ScatteringImage dipole(const ScatteringPoint& at) const {
    return dipole_pilot(system_.weights, knots_, at, channel_.eta_int_over_ext);
  }

  void report(const TransportRound& round, ChannelResult& result) const {
    const Eigen::VectorXd variance = round.row_variance(simulation_.area_mm2(), 1.0);
    report_fit(round, system_, scale_, variance, result);
    refuse_unresolved(simulation_.area_mm2(), result.estimate);
    report_rows(channel_, rows_, result);
    std::vector<ShotRows> rows =
        shot_rows(channel_, rows_, system_.l - round.residual(), variance.cwiseSqrt());
    result.look = residual_look(rows, channel_);
    if (options_.keep_rows) result.rows = std::move(rows);
    apply_mesh_scale(channel_, result.estimate);
    report_shots(round, channel_, result);
    result.has_enough_paths =
        round.has_enough_paths() ||
        next_blocks(round.at(), round.blocks(), budget_.with(blocks_of(options_.paths))) == 0;
    refuse_undetermined(result.estimate);
  }

  const Scene& scene_;
  const MaterialChannel& channel_;
  DistanceKnots knots_;
  DenseSystem system_;
  ChannelRows rows_;
  ScalePrior scale_;
  const EstimateOptions& options_;
  const ProgressStage& stage_;
  ChannelSimulation simulation_;
  MediumNuisances medium_;
  ShotParts parts_;
  PathPilots pilots_;
  PathBudget budget_;
};

}  // namespace

bool search_by_transport(const Scene& scene, const MaterialChannel& channel,
                         const DipoleSystem& dipole, TransportAtlas& atlas, bool may_trace,
                         const EstimateOptions& options, const ProgressStage& stage,
                         ChannelResult& result) {
  ChannelResult found = result;
  try {
    TransportSearch(scene, channel, dipole, atlas, may_trace, options, stage).run(found);
  } catch (const ChannelSimulation::PathsMissing&) {
    return false;
  }
  result = std::move(found);
  return true;
}

}  // namespace scattermeter
