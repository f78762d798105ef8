#include "core/fit/dipole_fit.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "core/base/chi_square.h"
#include "core/base/side_by_side.h"
#include "core/diffusion/dipole_curve.h"
#include "core/fit/fit_uncertainty.h"
#include "core/fit/profile_interval.h"
#include "core/fit/recovered_reflectance.h"
#include "core/fit/residual.h"
#include "core/fit/score_tests.h"

namespace scattermeter {
namespace {

using Point = DipoleSolver::Point;
using Coefficient = DipoleSolver::Coefficient;

// Standard deviations, correlation, budget and scale; if the model explains the image, the profile
// of the likelihood where the quadratic approximation of the chi-square is not good enough for an
// interval.
void set_uncertainty(const FitUncertainty& fit, const DipoleSolver& solver, const Point& p,
                     double noise_inflation, bool explains, Estimate& estimate) {
  const Eigen::Matrix2d all = fit.covariance([](const std::string&) { return false; });
  Quantity& s = estimate.sigma_s_prime_per_mm;
  Quantity& a = estimate.sigma_a_per_mm;
  s = normal_quantity(p.sigma_s_prime_per_mm(), std::sqrt(all(0, 0)));
  a = normal_quantity(p.sigma_a_per_mm(), std::sqrt(all(1, 1)));
  estimate.correlation = all(0, 1) / std::sqrt(all(0, 0) * all(1, 1));
  const double scale = std::exp(p.log_s);
  estimate.scale = normal_quantity(scale, scale * fit.log_scale_std());
  const Eigen::Matrix2d noise = fit.by_noise();
  estimate.budget.push_back(
      {"noise", std::sqrt(std::max(0.0, noise(0, 0))), std::sqrt(std::max(0.0, noise(1, 1)))});
  for (const std::string& cause : fit.causes()) {
    const Eigen::Matrix2d rest = fit.covariance([&](const std::string& c) { return c == cause; });
    estimate.budget.push_back({cause, std::sqrt(std::max(0.0, all(0, 0) - rest(0, 0))),
                               std::sqrt(std::max(0.0, all(1, 1) - rest(1, 1)))});
  }
  // The chi-square is parabolic over a few per cent of a coefficient, but not over tens, nor near
  // sigma_a = 0.
  constexpr double kParabolic = 0.1;
  if (!explains) return;
  if (!(s.std > kParabolic * s.value) && !(a.std > kParabolic * a.value)) return;
  if (!std::isfinite(s.std) || !std::isfinite(a.std)) return;
  // Nuisances that are not fitted widen the interval as they widen the standard deviation.
  const Eigen::Matrix2d fitted = fit.covariance_of_fitted();
  const auto profile = [&](Coefficient which, Eigen::Index i, Quantity& q) {
    const double wider = all(i, i) / fitted(i, i);
    // `fitted` is inflated; the solver's chi-square is not.
    const Interval interval =
        profile_interval(solver, p, which, std::sqrt(fitted(i, i) / noise_inflation),
                         3.841 * noise_inflation * wider);
    q.low95 = interval.low;
    q.high95 = interval.high;
    // If the profile rises within one deviation, it has met the wall of a narrow basin, beside
    // which there may be others.
    if (q.low95 > q.value - q.std) q.low95 = std::min(q.low95, q.value - 1.96 * q.std);
    if (q.high95 < q.value + q.std) q.high95 = q.value + 1.96 * q.std;
    q.low95 = std::max(0.0, q.low95);
  };
  side_by_side([&] { profile(Coefficient::kSigmaSPrime, 0, s); },
               [&] { profile(Coefficient::kSigmaA, 1, a); });
  // The image tells less of a larger sigma_a: where noise has taken it too low, the deviation there
  // is too short to reach the true one.
  const double longer = (a.high95 - a.value) / (1.96 * a.std);
  if (!(longer > 1.0) || !std::isfinite(longer)) return;
  a.std *= longer;
  for (BudgetLine& line : estimate.budget) line.std_sigma_a_per_mm *= longer;
}

template <class... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream out;
  out.precision(3);
  (out << ... << parts);
  return out.str();
}

// Why the dipole does not explain the image, by its fit alone; "": it does.
std::string why_not_explained(const Estimate& e, const DipoleFitOptions& options) {
  const double unexplained = e.rms_relative * std::sqrt(std::max(0.0, 1.0 - 1.0 / e.reduced_chi2));
  const auto rows = static_cast<double>(e.rows);
  if (unexplained > options.max_unexplained_relative &&
      chi_square_tail(rows * e.reduced_chi2, rows) < options.misfit_p_value) {
    return sentence("the dipole does not explain the shots: residual of ", 100.0 * e.rms_relative,
                    " %, of which noise leaves ", 100.0 * unexplained, " % unexplained");
  }
  if (e.misfit_p_value < options.misfit_p_value &&
      e.misfit_relative > options.max_misfit_relative) {
    return sentence(
        "the dipole does not explain the shots: a smooth function of distance fits better by ",
        100.0 * e.misfit_relative,
        " % of the image (scale, light, pose or material are not as the rig states)");
  }
  return "";
}

// not_explained: as by why_not_explained().
void add_refusals(const DistanceKnots& knots, const Point& p, const std::string& not_explained,
                  Estimate& e) {
  const auto say = [&](const auto&... words) { e.reasons.push_back(sentence(words...)); };
  if (!e.converged) {  // its values say nothing about patches or material
    if (!not_explained.empty()) say(not_explained);
    return say("the fit did not converge");
  }
  const double mfp_mm = std::exp(-p.u);
  // Knots are a sixteenth of the patch apart at the source; over patches longer than three mean
  // free paths the light bends more than their quadrature follows.
  if (mfp_mm < 5.0 * knots.resolution_mm()) {
    say("the mean free path, ", mfp_mm,
        " mm, is too short for the patches: choose a patch size below ", 3.0 * mfp_mm, " mm");
  }
  // Beyond, light is absorbed within a patch: with 1 / sigma_tr of three quarters of it and less,
  // the error was up to 6 % in sigma_s' (tests/core/fit/dipole_stress_test.cc).
  const double decay_mm = mfp_mm / std::sqrt(3.0 * p.q);
  if (decay_mm < 12.0 * knots.resolution_mm() && mfp_mm >= 5.0 * knots.resolution_mm()) {
    say("the light dies off within ", decay_mm,
        " mm, too short for the patches: choose a patch size below ", decay_mm / 0.75, " mm");
  }
  if (mfp_mm > 0.5 * knots.max_distance_mm()) {
    say("the mean free path, ", mfp_mm,
        " mm, is not small against the object: the dipole does not apply");
  }
  if (p.q > 0.7) {
    say("the albedo alpha' = ", 1.0 - p.q,
        " is too low for the dipole, which requires alpha' near 1");
  }
  refuse_undetermined(e);
  if (!not_explained.empty()) say(not_explained);
}

// How much of the image only r explains; returns its reduced chi-square over the noise's.
double set_misfit(const RecoveredReflectance& recovered, double l2,
                  const std::vector<Nuisance>& fitted, const ScalePrior& scale, const Point& p,
                  bool without_noise, Estimate& estimate) {
  const auto rank = recovered.whitened.size();
  // Every prior adds one term and its parameter takes one away.
  const auto unbound = std::count_if(fitted.begin(), fitted.end(),
                                     [](const Nuisance& n) { return !std::isfinite(n.std); });
  const double dof = static_cast<double>(rank - 2 - (scale.is_free() ? 1 : 0) -
                                         static_cast<Eigen::Index>(unbound));
  if (!(dof > 0.0)) return 0.0;
  const double noise = recovered.noise_excess();
  const double cost = p.cost + (without_noise ? dof : 0.0);
  const double chi2 = cost / noise;
  estimate.misfit_p_value = chi_square_tail(chi2, dof);
  estimate.misfit_relative = std::sqrt(std::max(0.0, chi2 - dof) / (l2 / noise));
  return cost / dof;
}

// The optimum under the rig's priors, and from there that with wider ones where the image doubts
// them, which elsewhere may stand for the medium. The judgement is on the priors as stated.
struct Solved {
  RigPriors priors;
  std::vector<Nuisance> fitted;
  std::unique_ptr<DipoleSolver> solver;
  Point optimum;
  ModelJudgement judgement;
};

void set_solver(const RecoveredReflectance& recovered, const DistanceKnots& knots, double eta,
                Solved& out) {
  out.fitted = out.priors.fitted();
  out.solver = std::make_unique<DipoleSolver>(recovered, knots, out.fitted, eta, out.priors.scale);
}

void solve_with_doubt(const RecoveredReflectance& recovered, const DistanceKnots& knots,
                      const DipoleFitOptions& options, Solved& out) {
  const double eta = options.eta_int_over_ext;
  set_solver(recovered, knots, eta, out);
  const Point p = out.optimum = out.solver->best(options.near);
  out.judgement = judgement_of(out.priors, recovered, dipole_curve(knots, p.u, p.q, eta), p);
  if (widen_doubtful(out.judgement.pulls, options.joint_pulls, out.priors)) {
    set_solver(recovered, knots, eta, out);
    out.optimum = out.solver->nearest(p);
  }
}

// Refusals by the quantities of the rig and by the light of the parts.
void add_contradictions(const DipoleFit& fit, const Solved& solved, const DipoleFitOptions& options,
                        Estimate& estimate) {
  estimate.pulls = solved.judgement.pulls;
  const PriorPull* worst = contradiction(estimate.pulls, kMostPull, kLeastPullImage);
  const std::string doubt = worst != nullptr ? contradiction_sentence(*worst, estimate.pulls)
                                             : far_eta(estimate.pulls, options.eta_int_over_ext);
  if (!doubt.empty()) estimate.reasons.push_back(doubt);
  const LackOfFit parts =
      misfit_of_parts(fit.image.parts, solved.priors.nuisances, solved.priors.scale);
  if (parts.p_value < options.misfit_p_value && parts.rms > options.max_parts_relative) {
    estimate.reasons.push_back(
        sentence("the dipole does not explain the shots: parts of the image are ",
                 100.0 * parts.rms, " % off"));
  }
}

}  // namespace

void DipoleFitOptions::Check() const {
  if (!(eta_int_over_ext > 0.0)) throw std::invalid_argument("DipoleFitOptions.eta_int_over_ext");
  if (!(scale.relative_std >= 0.0)) throw std::invalid_argument("DipoleFitOptions.scale");
  if (!(all_rows >= 1.0)) throw std::invalid_argument("DipoleFitOptions.all_rows");
  if (!(misfit_p_value > 0.0)) throw std::invalid_argument("DipoleFitOptions.misfit_p_value");
}

DipoleFit fit_dipole(const DenseSystem& system, const DistanceKnots& knots,
                     const DipoleFitOptions& options) {
  return fit_dipole(SystemRows(system), image_information(system), knots, options);
}

DipoleFit fit_dipole(const ImageRows& rows, const ImageInformation& image,
                     const DistanceKnots& knots, const DipoleFitOptions& options) {
  options.Check();
  DipoleFit fit;
  Estimate& estimate = fit.estimate;
  estimate.rows = image.rows;
  if (estimate.rows < options.min_rows) {
    estimate.reasons.push_back(sentence("only ", estimate.rows, " patches can be used, at least ",
                                        options.min_rows, " are needed"));
    return fit;
  }
  if (!image.is_sound) {
    estimate.reasons.push_back("the image or its prediction contains values that are not finite");
    return fit;
  }
  fit.recovered = recover_reflectance(image);
  if (options.without_noise) {
    fit.recovered.floor_chi2 +=
        static_cast<double>(image.rows) - static_cast<double>(fit.recovered.whitened.size());
  }
  const RecoveredReflectance& recovered = fit.recovered;
  if (recovered.whitened.size() < 3) {
    estimate.reasons.push_back("no light reaches the object in these shots");
    return fit;
  }
  Solved solved;
  solved.priors = {rows.nuisances(), options.scale};
  solve_with_doubt(recovered, knots, options, solved);
  fit.evidence = solved.judgement.evidence;
  const ScalePrior& scale = solved.priors.scale;
  fit.optimum = solved.optimum;
  const Point& p = fit.optimum;
  estimate.converged = p.converged;
  const DipoleCurve curve = dipole_curve(knots, p.u, p.q, options.eta_int_over_ext);
  fit.image = compared_image(rows, knots, p, options.eta_int_over_ext);
  const Residual rest = residual(fit.image.l, fit.image.predicted, fit.image.std_l);
  const int n_parameters = scale.relative_std == 0.0 ? 2 : 3;
  estimate.reduced_chi2 = rest.chi2 / (static_cast<double>(image.rows) - n_parameters) +
                          (options.without_noise ? 1.0 : 0.0);
  estimate.rms_relative = rest.rms_relative;
  estimate.psnr_db = rest.psnr_db;
  const double misfit =
      set_misfit(recovered, image.l2, solved.fitted, scale, p, options.without_noise, estimate);
  // Errors that neighbours share do not average out among them.
  const LackOfFit cells = misfit_of_cells(fit.image);
  double inflation = std::max({1.0, estimate.reduced_chi2, cells.chi2 / cells.dof});
  // The dipole's misfit lies in the few directions that r can explain, as the coefficients do;
  // averaged over all rows it would be diluted. It is taken as equal in all those directions (Birge
  // 1932).
  if (estimate.misfit_p_value < options.misfit_p_value) inflation = std::max(inflation, misfit);
  // Errors of the method are at least as large as the misfit that is seen.
  std::vector<Nuisance> nuisances = solved.priors.nuisances;
  for (Nuisance& n : nuisances) {
    if (!n.fitted && n.std > 0.0 && estimate.misfit_p_value < options.misfit_p_value) {
      n.std = std::max(n.std, options.misfit_margin * estimate.misfit_relative);
    }
  }
  // If the image contradicts the values stated in the rig, the result is widened or refused.
  const ScoreTests tests = score_tests(recovered, solved.priors.nuisances, knots, p,
                                       options.eta_int_over_ext, scale, recovered.noise_excess());
  RecoveredReflectance widened = recovered;
  for (const auto& [test, name] : {std::pair{&tests.scale, "scale"}, {&tests.eta, "eta"}}) {
    if (!(test->p_value < options.misfit_p_value)) continue;
    widened.sqrt_information.conservativeResize(Eigen::NoChange,
                                                widened.sqrt_information.cols() + 1);
    widened.sqrt_information.rightCols(1) = test->per_offset;
    nuisances.push_back({name, std::abs(test->offset), false});
    if (test->image_relative > options.max_offset_relative &&
        test->explained_relative > kLeastExplained) {
      estimate.reasons.push_back(contradiction_sentence(*test, name));
    }
  }
  const auto uncertainty = [&](double times) {
    return FitUncertainty(widened, nuisances, curve, p.u, p.q, std::exp(p.log_s), scale,
                          inflation / times);
  };
  const std::string not_explained = why_not_explained(estimate, options);
  set_uncertainty(uncertainty(1.0), *solved.solver, p, inflation, not_explained.empty(), estimate);
  fit.more_rows = more_rows(uncertainty, options.all_rows);
  add_refusals(knots, p, not_explained, estimate);
  add_contradictions(fit, solved, options, estimate);
  return fit;
}

}  // namespace scattermeter
