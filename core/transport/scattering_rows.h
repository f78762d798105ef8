// The image of one view under one light by Monte Carlo, row by row.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/light/entry_source.h"
#include "core/material/scattering_medium.h"
#include "core/mesh/patch_mesh.h"
#include "core/transport/camera_connection.h"
#include "core/transport/path_boundary.h"
#include "core/transport/path_tracer.h"
#include "core/transport/scattering_view.h"

namespace scattermeter {

// l of every row (the mean over its patch, paper eq. 11), per unit of the light's power, and its
// derivatives by the medium; all from the same paths.
struct ScatteringImage {
  Eigen::VectorXd l;
  Eigen::VectorXd per_log_sigma_s;  // dl / d log sigma_s at constant sigma_a and g
  Eigen::VectorXd per_sigma_a;      // dl / d sigma_a, times mm
  Eigen::VectorXd variance;         // of l; the rows' errors are not independent
};

// Sums paths in one medium, block by block. The derivatives are those of the paths' weights
// under a change of the medium (perturbation Monte Carlo): a path of n scatterings and length L in
// the body weighs sigma_s^n exp(-sigma_t L).
class ScatteringSum {
 public:
  // projection (any number of rows x rows of the view; may have no rows): linear combinations of l
  // whose covariance is required. The view must outlive the object.
  ScatteringSum(const ScatteringView& view, const Eigen::MatrixXd& projection);

  // Traces `n` further blocks. The same calls give the same digits on any number of threads.
  void trace(const PathWorld& world, const PathOptions& options, int n);

  int blocks() const { return blocks_; }
  const PathAudit& audit() const { return audit_; }
  // Precondition: blocks() >= 2.
  ScatteringImage image() const;
  // Covariance of projection * image().l, from the scatter of the blocks.
  Eigen::MatrixXd projected_covariance() const;

 private:
  const ScatteringView& view_;
  Eigen::MatrixXd projection_;
  double sigma_s_ = 0;
  int blocks_ = 0;
  PathAudit audit_;
  Eigen::VectorXd weight_, weight_n_, weight_length_, square_;
  Eigen::VectorXd projected_;
  Eigen::MatrixXd projected_square_;
};

}  // namespace scattermeter
