// Fit of the dipole to the recovered reflectance of an image.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/fit/compared_image.h"
#include "core/fit/dipole_solver.h"
#include "core/fit/estimate.h"
#include "core/fit/image_information.h"
#include "core/fit/image_rows.h"
#include "core/fit/linear_shot.h"
#include "core/fit/prior_pulls.h"
#include "core/fit/recovered_reflectance.h"
#include "core/fit/rig_priors.h"

namespace scattermeter {

struct DipoleFitOptions {
  double eta_int_over_ext = 1.3;
  ScalePrior scale;
  // Verdict limits.
  std::size_t min_rows = 20;
  // The dipole is refused when its residual exceeds the noise significantly (misfit_p_value) and by
  // more than this, relative to the image. Below, the excess widens the errors.
  double max_unexplained_relative = 0.01;
  // The same for the light of the parts into which the image is divided.
  double max_parts_relative = 3e-3;
  // A misfit is significant if it is less probable than misfit_p_value under the dipole. A
  // significant misfit counts `misfit_margin` times as an error of the method (nuisances that are
  // not fitted), and the dipole is refused if it exceeds max_misfit_relative.
  double misfit_p_value = 1e-6;
  double misfit_margin = 2.0;
  double max_misfit_relative = 2e-3;
  // Where the image contradicts the stated scale or eta (core/fit/score_tests.h) with that
  // significance, the offset counts as an error of the method, and the result is refused if the
  // offset changes the image by more than max_offset_relative.
  double max_offset_relative = 1e-2;
  // For an image of expected values, free of the noise that its std_l states: fit quality, the
  // widening of errors by it, and verdicts are then those expected with that noise (chi-square
  // increased by one per degree of freedom).
  bool without_noise = false;
  JointPulls joint_pulls = {};                             // known from other channels
  std::optional<DipoleSolver::Point> near = std::nullopt;  // one more start of the search
  // All rows over those of the image, at least 1; above 1, DipoleFit::more_rows is filled.
  double all_rows = 1;
  void Check() const;  // std::invalid_argument naming the field
};

struct DipoleFit {
  Estimate estimate;
  DipoleSolver::Point optimum;
  // Predicted at the optimum, and observed. Empty if there is no optimum.
  ComparedImage image;
  RecoveredReflectance recovered;
  RigEvidence evidence;             // under the priors as stated
  std::vector<MoreRows> more_rows;  // from 1 in steps of 2 to DipoleFitOptions::all_rows
};

// The dipole of least chi-square on the image (DipoleSolver). Standard deviations from the Jacobian
// at the optimum, widened by sqrt(reduced chi-square) where that exceeds 1; intervals are +-1.96
// std, cut at 0, or from the profile likelihood where a standard deviation exceeds a tenth of its
// value; that of sigma_a is then at least the upper part of its interval over 1.96. A significant
// misfit counts per direction of r instead of per row, and widens the errors
// of the method; so does a stated scale or eta that the image contradicts. Where the image does not
// determine the scale (uniform light), an error of a scale stated as exact cannot be detected. The
// result lists its reasons for refusal: too few rows, values that are not finite, not converged, a
// mean free path outside what the knots resolve, an undetermined sigma_s', no upper limit, a
// residual the dipole cannot explain, a scale or an eta that the image contradicts.
DipoleFit fit_dipole(const DenseSystem& system, const DistanceKnots& knots,
                     const DipoleFitOptions& options);
// The same with the image's information (of all its shots) already computed; its rows are visited
// once more.
DipoleFit fit_dipole(const ImageRows& rows, const ImageInformation& image,
                     const DistanceKnots& knots, const DipoleFitOptions& options);

}  // namespace scattermeter
