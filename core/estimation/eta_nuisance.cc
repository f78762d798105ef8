#include "core/estimation/eta_nuisance.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/base/dense_solve.h"
#include "core/material/eta_change.h"

namespace scattermeter {

void EtaNuisance::set_rows(const ChannelRows& rows, const std::vector<Eigen::Index>& kept) {
  by_dipole_ = Eigen::VectorXd(by_dipole_(kept));
  std::vector<double> observed;
  for_used_rows(rows, [&](std::size_t s, std::size_t j) {
    observed.push_back(
        observed_growth(channel_.eta_int_over_ext, channel_.shots[s]->seen->cos_to_camera(j)));
  });
  observed_ = Eigen::Map<const Eigen::VectorXd>(observed.data(),
                                                static_cast<Eigen::Index>(observed.size()));
}

Eigen::VectorXd EtaNuisance::column(const ShotParts& parts, const ScatteringImage& smooth,
                                    double scale, bool scale_is_free, const Eigen::VectorXd& paths,
                                    const Eigen::VectorXd& per_eta) const {
  const Eigen::VectorXd l = scale * smooth.l;
  const Eigen::VectorXd observed = observed_.cwiseProduct(l);
  Eigen::MatrixXd terms(l.size(), 4);
  terms << scale * smooth.per_log_sigma_s, scale * smooth.per_sigma_a, l, by_dipole_ + observed;
  // All relative to the light of their part.
  Eigen::MatrixXd of_parts(parts.n_parts(), terms.cols());
  for (Eigen::Index k = 0; k < terms.cols(); ++k) of_parts.col(k) = parts.of_parts(terms.col(k));
  const Eigen::ArrayXd light = of_parts.col(2).array();
  of_parts.array().colwise() /= light;
  const Eigen::VectorXd wanted = parts.of_parts(per_eta).cwiseQuotient(parts.of_parts(paths));
  // Few parts may not tell all terms apart: the smallest solution.
  const Eigen::Vector4d by_term = solve_min_norm(of_parts, wanted);
  const Eigen::Index beside = scale_is_free ? 1 : 2;  // the terms that are not of the medium
  return terms.rightCols(beside) * by_term.tail(beside) - observed;
}

}  // namespace scattermeter
