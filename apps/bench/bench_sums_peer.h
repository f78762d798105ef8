// Plain implementations of fitting the dipole, and the one by sums over clusters, on the same data.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/material/medium.h"

namespace scattermeter::apps {

// l_j at every patch, computed by direct sums for the true medium.
struct PeerProblem {
  std::vector<Eigen::Vector3d> points_mm;
  std::vector<double> c;  // of each point
  Eigen::VectorXd l;
  Medium truth;
};

struct PeerResult {
  std::string method;
  double seconds = 0;
  double error_sigma_s_prime = 0;  // relative, like the next
  double error_sigma_a = 0;
};

// The problem of the paper's simulation: points lit from one side, 2.19 / 0.002 per mm, eta 1.3.
PeerProblem peer_problem(const std::vector<Eigen::Vector3d>& points_mm,
                         const std::vector<double>& c);

// The paper's method as published: all distances in one matrix, W of knots `width_mm` apart, its
// pseudo-inverse, and the grid of sigma_s 0.01 .. 3.00 and sigma_a 0 .. 0.010.
PeerResult fit_dense(const PeerProblem& problem, double width_mm);
// The same without the matrix of distances: normal equations from one chunk of rows at a time.
PeerResult fit_chunked(const PeerProblem& problem, double width_mm);
// Gauss-Newton on the sums over clusters and their derivatives, from a distant start.
PeerResult fit_sums(const PeerProblem& problem);

}  // namespace scattermeter::apps
