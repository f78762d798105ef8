// Whether an image contradicts what the rig states about its uncertain quantities.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/fit/estimate.h"
#include "core/fit/linear_shot.h"

namespace scattermeter {

// A linear model of whitened data: residual = free x + columns diag(std) v + noise, with the
// unknowns x free, v standard normal and the noise of unit variance.
struct WhitenedModel {
  Eigen::VectorXd residual;  // data minus the model with all nuisances at their nominal values
  // Rows x unknowns; the first two, if any, per 1/mm of sigma_s' and sigma_a.
  Eigen::MatrixXd free;
  Eigen::MatrixXd columns;          // rows x nuisances, per unit of each
  std::vector<Nuisance> nuisances;  // infinite std: free; 0: stated as exact, to be tested
  double data_length = 0;           // |data|, to which changes of the image are compared
};

// What the data say about the nuisances that vary, all unknowns eliminated: with their values v in
// deviations of their priors, chi2 = v^T information v - 2 score^T v + constant, and the priors add
// v^T v.
struct RigEvidence {
  std::vector<Nuisance> nuisances;
  Eigen::MatrixXd information;
  Eigen::VectorXd score;
  Eigen::VectorXd image_relative;  // change of the image by one deviation, relative to the image
  double data_length = 0;          // of the whitened image
};

struct ModelJudgement {
  double chi2 = 0;  // of the residual with nuisances and unknowns at their most probable values
  double dof = 0;   // rows minus free unknowns
  double p_value = 1;
  std::vector<PriorPull> pulls;  // of the nuisances that are fitted or exact, in their order
  RigEvidence evidence;
};

// The pull of a nuisance is its most probable value over the standard deviation that this value has
// if all statements hold, sqrt(std^2 - posterior variance): then a standard normal variable,
// however little the image tells about the nuisance. For a quantity stated as exact it is the root
// of the score statistic.

// Nuisances that are not fitted but have std > 0 (errors of the method) vary as well and have no
// pull. Those that the unknowns imitate to rounding have pull 0.
ModelJudgement judge(const WhitenedModel& model);

// Results are refused where the image contradicts what the rig states about a quantity by more than
// kMostPull standard deviations, which happens to one quantity in 16,000 by chance (to one rig of
// thirty quantities and three channels in 180), and by more than kLeastPullImage of the image. By
// transport, whose covariance of paths is an estimate: of 79 answers on rendered rigs, none within
// what the rig states was above 2.8; those of one that was 50 % off reached 4.8.
inline constexpr double kMostPull = 4.0;
inline constexpr double kLeastPullImage = 1e-3;
// A pull beyond this casts doubt on the stated deviation; 4.6 % of all pulls are by chance.
inline constexpr double kDoubtfulPull = 2.0;
// From here on, whatever it changes: something looks like it. Of 1709 answers of rigs within what
// they state (`bench deviations`, dipole), none had a pull above 4.2; an LED with a narrow beam of
// 5 % looks like a lobe 4.8 deviations off, which changes the image by less than 1e-3.
inline constexpr double kClearPull = 4.5;
// Nor does a pull count that explains less of the residual than this, relative to the image: the
// linear model leaves out the products of two deviations, one per cent of one per cent.
inline constexpr double kLeastExplained = 1e-4;
// Unless it is visible and larger than this: in frames of ten million pixels, whose noise hides no
// deviation, a mesh stretched by 0.5 % explained less and yet moved sigma_s' by 2.5 %. Rigs within
// what they state had visible pulls of at most 2.5 there.
inline constexpr double kFarPull = 5.0;

// The largest contradiction that is significant (|pull| > most_pull), visible (image_relative >
// least_image) or clear, and explains enough of the image (explained_relative > least_explained) or
// is visible and far; null if there is none. Visible ones come first.
const PriorPull* contradiction(const std::vector<PriorPull>& pulls, double most_pull,
                               double least_image, double least_explained = kLeastExplained);

// A sentence for the user that names the quantity, the size of the contradiction and the next step,
// and at most two other groups among the pulls that would explain the image nearly as well.
std::string contradiction_sentence(const PriorPull& worst, const std::vector<PriorPull>& pulls);

// Of the dipole: the shots put eta farther from the stated one than tables are off, by three of the
// default deviations: what looks like it is something else, such as blur at the limb of a sphere.
// "" elsewhere.
std::string far_eta(const std::vector<PriorPull>& pulls, double eta_int_over_ext);

// Where other images see an error of the quantity already from so many of its deviations on, what
// is unseen is less: does nothing unless that is less than pull.least_seen_in_std.
void see_from(double least_seen_in_std, PriorPull& pull);
// What is unseen, where one deviation of the quantity moves log sigma_s and sigma_a by the first
// two of `moves`.
void set_unseen(const Eigen::VectorXd& moves, double sigma_s_per_mm, PriorPull& pull);
// By how many of its stated deviations (of sigma_s' or sigma_a, whichever is more) an error of the
// quantity that these shots just do not contradict shifts the estimate.
double unseen_in_std(const PriorPull& pull, const Estimate& estimate);
// An estimate rests on a quantity for which that is more than this: nothing but the rig's word
// stands for it.
inline constexpr double kMostUnseen = 6.0;
// The quantities that it rests on, of each group the worst, the worst first.
std::vector<PriorPull> rests_on(const Estimate& estimate);
// "rests on the stated scale, LED power: an error of scale of up to 15 stated deviations would not
// show, and would shift sigma_s' by 0.66 and sigma_a by 0.02 /mm"; "" if there are none.
std::string rests_on_sentence(const Estimate& estimate);

}  // namespace scattermeter
