#include "core/fit/marginal_information.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "core/base/dense_solve.h"

namespace scattermeter {

MarginalInformation marginal_information(const RecoveredReflectance& recovered,
                                         const std::vector<Nuisance>& nuisances,
                                         Eigen::Index n_knots, NuisanceUse use) {
  const Eigen::MatrixXd& a = recovered.sqrt_information;
  if (a.cols() != n_knots + static_cast<Eigen::Index>(nuisances.size())) {
    throw std::invalid_argument("marginal_information: " + std::to_string(a.cols()) +
                                " columns for " + std::to_string(n_knots) + " knots and " +
                                std::to_string(nuisances.size()) + " nuisances");
  }
  const Eigen::Index rows = a.rows();
  std::vector<Eigen::Index> moving;
  std::vector<Eigen::Index> held;
  for (std::size_t i = 0; i < nuisances.size(); ++i) {
    if (!(nuisances[i].std > 0.0)) continue;
    const bool moves = nuisances[i].fitted || use == NuisanceUse::kAll;
    (moves ? moving : held).push_back(static_cast<Eigen::Index>(i));
  }
  const auto is_free = [&](Eigen::Index i) {
    return !std::isfinite(nuisances[static_cast<std::size_t>(i)].std);
  };
  const auto column = [&](Eigen::Index i) {
    const double unit = is_free(i) ? 1.0 : nuisances[static_cast<std::size_t>(i)].std;
    return Eigen::VectorXd(a.col(n_knots + i) * unit);
  };
  const auto n = static_cast<Eigen::Index>(moving.size());
  const auto n_held = static_cast<Eigen::Index>(held.size());
  // Rows: the image's, then the priors' of those that move, in units of their deviations; what is
  // free has none.
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows + n, n_knots + 1 + n_held);
  all.topLeftCorner(rows, n_knots) = a.leftCols(n_knots);
  all.col(n_knots).head(rows) = recovered.whitened;
  for (Eigen::Index i = 0; i < n_held; ++i) {
    all.col(n_knots + 1 + i).head(rows) = column(held[static_cast<std::size_t>(i)]);
  }
  if (n > 0) {
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows + n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Index nuisance = moving[static_cast<std::size_t>(i)];
      columns.col(i).head(rows) = column(nuisance);
      columns(rows + i, i) = is_free(nuisance) ? 0.0 : 1.0;
    }
    all = HouseholderSolver(columns).rotate_columns(all);
  }
  // What the moving ones can explain is in the first n rows; the rest depends on r alone.
  return {all.bottomLeftCorner(rows, n_knots), all.col(n_knots).tail(rows),
          all.bottomRightCorner(rows, n_held)};
}

}  // namespace scattermeter
