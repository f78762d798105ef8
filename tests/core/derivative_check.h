// Analytic derivatives against central differences.
#pragma once

#include <cmath>
#include <functional>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace scattermeter::test_support {

// f: parameters -> values; jacobian: values x parameters at x. Steps are relative to each parameter
// (or absolute where it is 0). Prints both matrices where they differ by more than `tolerance` of
// the column's largest entry.
inline void expect_derivatives(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f,
                               const Eigen::VectorXd& x, const Eigen::MatrixXd& jacobian,
                               double tolerance = 1e-6) {
  Eigen::MatrixXd numeric(jacobian.rows(), jacobian.cols());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double h = 1e-5 * (x[i] != 0.0 ? std::abs(x[i]) : 1.0);
    Eigen::VectorXd high = x, low = x;
    high[i] += h;
    low[i] -= h;
    numeric.col(i) = (f(high) - f(low)) / (high[i] - low[i]);
  }
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double scale = numeric.col(i).cwiseAbs().maxCoeff();
    EXPECT_LE((numeric.col(i) - jacobian.col(i)).cwiseAbs().maxCoeff(), tolerance * scale)
        << "parameter " << i << "\nanalytic\n"
        << jacobian << "\nnumeric\n"
        << numeric;
  }
}

}  // namespace scattermeter::test_support
