// Verdicts on a round of the search by transport.
#pragma once

#include <vector>

#include "core/fit/estimate.h"
#include "core/fit/lack_of_fit.h"
#include "core/fit/scattering_equation.h"

namespace scattermeter {

struct ChannelResult;
struct MaterialChannel;
class TransportRound;

// In these functions, `blocks` is the number of blocks of paths traced in a round for each light
// and view.

// The least number for which the covariances of a shot's parts are usable.
inline constexpr int kLeastBlocks = 64;
// The number of blocks with which a search ends that neither time nor paths limit.
inline constexpr int kFinalPathBlocks = 512;

// Of the light at the end of a search: of a final number of blocks, and scatter as of these.
struct PathErrors {
  double scatter = 1;  // TransportRound::scatter()
  int blocks = 0;
  int final_blocks = kFinalPathBlocks;
  // Variance relative to that of one block.
  double of_block() const { return 1.0 / final_blocks + (scatter - 1.0) / blocks; }
};
// Before any round: scatter as large as Monte Carlo at the end of the search. Weights for twice its
// variance are hardly worse where the shots add none, and far better where they do.
PathErrors first_errors(int blocks, int final_blocks);
// Whether a round's errors are hardly larger than those that its weights assume. Otherwise they are
// far from the best: a cube of 1.5 per mm was measured to 28 % where the next round had 8 %.
bool fits_weights(const PathErrors& found, const PathErrors& assumed);

// A misfit of the parts less probable than this widens the estimate.
inline constexpr double kWideningPValue = 1e-2;

// Whether the step is so short that its nonlinear part, about half its square, is small compared
// with the final standard deviation of the result, or small in itself. With few blocks it has to be
// shorter, lest paths be spent at a point that turns out to be too far away; and so it has where
// the image is not explained: Gauss-Newton steps towards a root far off are too short as long as
// the residual is large, and the deviations that the residual widens excuse anything.
bool is_close(const ScatteringEquation::Step& step, int blocks, const LackOfFit& misfit);

// Whether a step is no longer than its error, about, so that further paths tell more than the step.
bool is_noise(const ScatteringEquation::Step& step);

// Whether the Monte Carlo error is small compared with all others, or smaller than ever needed.
bool is_precise(const ScatteringEquation::Step& step, double sigma_a_per_mm, int blocks);
// Whether the image speaks against the rig or the model, yet not loudly enough to refuse the
// result: smaller errors of paths would tell.
bool is_in_doubt(const LackOfFit& misfit, const std::vector<PriorPull>& pulls);

// Writes values, standard deviations, budget and scale at the step's end into the estimate.
void report_step(const ScatteringEquation::Step& step, Estimate& estimate);

// Whether sigma_s' has the smaller relative deviation.
bool is_better(const Estimate& one, const Estimate& other);

// Adds the estimates of the shots one by one and their agreement, by which the joint one is
// widened.
void report_shots(const TransportRound& round, const MaterialChannel& channel,
                  ChannelResult& result);

// Rows of dust and scratches: Monte Carlo's tails are long, but end before these. area_mm2: by row.
std::vector<Eigen::Index> outlying_rows(const TransportRound& round,
                                        const std::vector<double>& area_mm2);

// Writes values, residual, pulls and evidence of a round whose rows are the system's, with any
// reasons for refusal; a contradicted scale widens the deviations. scale: as stated; variance:
// round.row_variance() of noise and Monte Carlo alone.
void report_fit(const TransportRound& round, const DenseSystem& system, const ScalePrior& scale,
                const Eigen::VectorXd& variance, ChannelResult& result);

// Adds a reason where what is left of the image, the nuisances at their most probable values,
// exceeds 30 % of it: paths that are so noisy explain any image.
void refuse_noisy(double rest_relative, Estimate& estimate);

// Adds a reason where the light of the estimate's medium reaches less than a tenth of a patch
// (1 / sqrt(3 sigma_a sigma_t'), of the median patch): then the patches show the ratio of both
// coefficients, and little of either. area_mm2: of the patches.
void refuse_unresolved(const std::vector<double>& area_mm2, Estimate& estimate);

// Adds the misfit, the pulls and any reasons for refusal to an estimate whose values are already
// set. unexplained: see TransportRound::unexplained().
void add_refusals(const LackOfFit& misfit, double unexplained, std::vector<PriorPull> pulls,
                  const ScatteringEquation::ScaleTest& scale, int blocks, Estimate& estimate);

}  // namespace scattermeter
