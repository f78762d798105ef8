// Covariance of a fitted lens.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "calib/lens/camera_bundle.h"

namespace scattermeter::calib {

struct LensUncertainty {
  bool determined = false;     // the normal equations can be solved; else all below is empty
  Eigen::MatrixXd covariance;  // of the fitted parameters, P x P
  double noise_std_px = 0;     // per coordinate: sqrt(r^T r / (2 n - 6 views - P))
  // Independent corner errors make the views' gradients g_i scatter with covariance
  // s^2 (S_i - S_i S^-1 S_i), S = sum S_i. What they scatter by, over that:
  //   sum_i g_i^T S^-1 g_i / (s^2 sum_i tr(W_i - W_i W_i)), W_i = S^-1 S_i.
  // Its mean is 1 for any layout (the bias-reduced sandwich of R. Bell, D. McCaffrey, "Bias
  // reduction in standard errors for linear regression with multi-stage samples", 2002, traced).
  // Above 1: corner errors are alike within a view (a bent board, a lens beyond the model, blur).
  double view_scatter = 1;
  double view_scatter_p = 1;  // of so much by chance (chi-square with Satterthwaite's freedom)
  // Where p is below 1e-3 the covariance has been multiplied by view_scatter.
  bool widened = false;
  // Each view's own part of view_scatter over its expectation.
  std::vector<double> scatter_of_view;
};

// At the least-squares solution. board_std_mm: standard deviation of each coordinate of a printed
// corner, the same in all views; its effect is added. Corners are told apart by world_mm to 1e-6
// mm.
LensUncertainty lens_uncertainty(const std::vector<BoardView>& views,
                                 const std::vector<ViewEquations>& equations, double board_std_mm);

}  // namespace scattermeter::calib
