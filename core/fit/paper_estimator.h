// The paper's own estimator: quantised distances, pseudo-inverse, grid.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/fit/estimate.h"
#include "core/fit/linear_shot.h"

namespace scattermeter {

// The paper's table 1: values tried for both coefficients, 1/mm.
struct PaperGrid {
  double sigma_s_min = 0.01, sigma_s_max = 3.00, sigma_s_step = 0.01;
  double sigma_a_min = 0.000, sigma_a_max = 0.010, sigma_a_step = 0.001;
};

// Quantisation widths of the paper's table 2, mm: 0.05 to 0.50 in steps of 0.05.
std::vector<double> paper_widths_mm();

// The estimate for one quantisation width.
struct PaperEstimate {
  double width_mm = 0;
  double sigma_s_prime_per_mm = 0;
  double sigma_a_per_mm = 0;
  double cost = 0;     // sum over knots of (R'_i - R(d'_i))^2 (eq. 30), 1/mm^4
  double psnr_db = 0;  // of the image re-rendered with the estimate through the same W
  double rms_relative = 0;
  double reduced_chi2 = 0;
  std::size_t rows = 0;
  Eigen::VectorXd r;  // R'_i = W⁺ l on the knots i * width, 1/mm^2
};

// Eq. 28 to 30 for one width: r = W⁺ l (unweighted, minimum norm where W lacks rank), then the best
// point of the grid. Knots without a nearby pair of patches (zero column of W) do not count in the
// grid's cost. eta: of the material.
PaperEstimate solve_paper(const DenseSystem& system, double width_mm, double eta_int_over_ext,
                          const PaperGrid& grid = {});

// The paper's procedure for photographs: of all widths, the estimate that re-renders the image
// best. The method gives no uncertainty; the one returned covers the choice of the width and the
// grid's steps: std^2 = variance over the widths + step^2 / 12. Refused if a coefficient is on a
// bound of the grid, since the true optimum may then lie outside. Precondition: not empty.
Estimate choose_width(const std::vector<PaperEstimate>& estimates, const PaperGrid& grid = {});

}  // namespace scattermeter
