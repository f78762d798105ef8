// Covariance of a fitted lens.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "calib/lens/camera_bundle.h"

namespace scattermeter::calib {

struct LensUncertainty {
  bool determined = false;     // the normal equations can be solved; otherwise the rest is empty
  Eigen::MatrixXd covariance;  // of the fitted parameters, P x P
  double noise_std_px = 0;     // per coordinate: sqrt(r^T r / (2 n - 6 views - P))
  // With independent corner errors the gradients g_i of the views scatter with covariance s^2 (S_i
  // - S_i S^-1 S_i), S = sum S_i. The ratio of the observed scatter to this:
  //   sum_i g_i^T S^-1 g_i / (s^2 sum_i tr(W_i - W_i W_i)), W_i = S^-1 S_i.
  // Its expectation is 1 for any layout (the bias-reduced sandwich of R. Bell, D. McCaffrey, "Bias
  // reduction in standard errors for linear regression with multi-stage samples", 2002, traced).
  // Above 1, corner errors are correlated within a view (a bent board, a lens beyond the model,
  // blur).
  double view_scatter = 1;
  double view_scatter_p = 1;  // chance of this much (chi-square with Satterthwaite's freedom)
  // p is below 1e-3 and the covariance was multiplied by view_scatter.
  bool widened = false;
  // The part of view_scatter due to each view, over its expectation.
  std::vector<double> scatter_of_view;
};

// The uncertainty at the least-squares solution. board_std_mm is the standard deviation of each
// coordinate of a printed corner, an error common to all views; its effect is added. Corners are
// identified by world_mm to 1e-6 mm.
LensUncertainty lens_uncertainty(const std::vector<BoardView>& views,
                                 const std::vector<ViewEquations>& equations, double board_std_mm);

}  // namespace scattermeter::calib
