// An image's rows and parts as observed and as the dipole predicts them.
#pragma once

#include <Eigen/Core>

#include "core/base/position_cells.h"
#include "core/diffusion/distance_weights.h"
#include "core/fit/dipole_solver.h"
#include "core/fit/estimate.h"
#include "core/fit/image_rows.h"
#include "core/fit/lack_of_fit.h"

namespace scattermeter {

// Sums of l over the parts of the shots, all relative to a part's observed l.
struct ComparedParts {
  Eigen::VectorXd residual;  // observed minus predicted, with all nuisances at their nominal values
  Eigen::VectorXd std;       // of the rows' noise
  Eigen::MatrixXd free;      // change with u, q and log scale
  Eigen::MatrixXd columns;   // change per unit of each nuisance
  // Sum over a part's rows of squared deviations from the part's mean residual, in deviations of
  // the rows, and its degrees of freedom.
  Eigen::VectorXd scatter_chi2;
  Eigen::VectorXd scatter_dof;
};

// Predicted and observed l of an image's rows, shot by shot.
struct ComparedImage {
  Eigen::VectorXd predicted;
  Eigen::VectorXd l;
  Eigen::VectorXd std_l;
  ComparedParts parts;     // of the shots that are divided into parts
  CellSquares neighbours;  // of the fit's residual, in deviations of the rows
};

// Predictions include the fitted nuisances.
ComparedImage compared_image(const ImageRows& rows, const DistanceKnots& knots,
                             const DipoleSolver::Point& point, double eta_int_over_ext);

// The misfit of the parts, beyond the rows' noise (raised to their scatter within the parts, the
// median over these), with the unknowns free and the nuisances within their priors. dof is 0 where
// there are too few parts for a test.
LackOfFit misfit_of_parts(const ComparedParts& parts, const std::vector<Nuisance>& nuisances,
                          const ScalePrior& scale);

// What neighbours share of the fit's residual: chi-square of the cells' means, its probability
// where rows are independent and their deviations as stated, and rms of the shared part, relative
// to the image. dof: the number of cells, at least 1.
LackOfFit misfit_of_cells(const ComparedImage& image);

}  // namespace scattermeter
