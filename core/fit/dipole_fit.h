// The dipole that explains the recovered reflectance.
#pragma once

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/fit/dipole_solver.h"
#include "core/fit/estimate.h"
#include "core/fit/image_information.h"
#include "core/fit/image_rows.h"
#include "core/fit/linear_shot.h"
#include "core/fit/recovered_reflectance.h"

namespace scattermeter {

struct DipoleFitOptions {
  double eta_int_over_ext = 1.3;
  ScalePrior scale;
  // Verdict limits.
  std::size_t min_rows = 20;
  double max_relative_std_sigma_s = 0.5;
  // The dipole is refused when its residual is significant and large: reduced chi-square above the
  // first and relative rms above the second.
  double max_reduced_chi2 = 4.0;
  double max_rms_relative = 0.01;
  // A misfit is significant when it were less probable than this if the dipole held. Significant,
  // it counts `misfit_margin` times as an error of the method (nuisances that are not fitted), and
  // the dipole is refused where it exceeds the last.
  double misfit_p_value = 1e-6;
  double misfit_margin = 2.0;
  double max_misfit_relative = 2e-3;
  // Where the image contradicts the stated scale or eta (core/fit/score_tests.h) as significantly
  // as that, the offset counts as an error of the method, and the result is refused where it
  // changes the image by more than the last, relative to the image.
  double max_offset_relative = 1e-2;
  // Of an image that shows what is expected, without the noise that its std_l states: fit quality,
  // what widens the errors by it, and verdicts are then those that are to be expected with that
  // noise (one more chi-square for each degree of freedom).
  bool without_noise = false;
  void Check() const;  // std::invalid_argument naming the field
};

// What is predicted and what was observed, of an image's rows, shot by shot.
struct ComparedImage {
  Eigen::VectorXd predicted;
  Eigen::VectorXd l;
  Eigen::VectorXd std_l;
};

struct DipoleFit {
  Estimate estimate;
  DipoleSolver::Point optimum;
  // On the image's rows, shot by shot: l at the optimum, and what was observed. Empty where there
  // is no optimum.
  ComparedImage image;
  RecoveredReflectance recovered;
};

// The dipole of least chi-square on the image (DipoleSolver). Standard deviations from the Jacobian
// at the optimum, widened by sqrt(reduced chi-square) where that exceeds 1; intervals are +-1.96
// std, cut at 0, and from the profile of the likelihood where a standard deviation exceeds a tenth
// of its value. A significant misfit counts per direction of r instead of per row, and widens the
// errors of the method; so does a stated scale or eta that the image contradicts. Where the image
// does not hold the scale (even light), a wrong exact scale cannot be seen. The result carries its
// reasons for refusal: too few rows, values that are not finite, not converged, a mean free path
// outside what the knots resolve, an undetermined sigma_s', no upper limit, a residual the dipole
// cannot explain, a scale or an eta that the image contradicts.
DipoleFit fit_dipole(const DenseSystem& system, const DistanceKnots& knots,
                     const DipoleFitOptions& options);
// The same with the image's information (of all its shots) at hand; its rows are gone through once
// more.
DipoleFit fit_dipole(const ImageRows& rows, const ImageInformation& image,
                     const DistanceKnots& knots, const DipoleFitOptions& options);

// With the nuisances that are fitted.
ComparedImage compared_image(const ImageRows& rows, const DistanceKnots& knots,
                             const DipoleSolver::Point& point, double eta_int_over_ext);

}  // namespace scattermeter
