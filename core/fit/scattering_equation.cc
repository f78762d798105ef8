#include "core/fit/scattering_equation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "core/base/chi_square.h"
#include "core/base/dense_solve.h"

namespace scattermeter {
namespace {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

}  // namespace

Eigen::MatrixXd ScatteringEquation::jacobian(const ScatteringImage& m, const ScatteringPoint& at,
                                             bool scale_moves) {
  Eigen::MatrixXd j(m.l.size(), scale_moves ? 3 : 2);
  j.col(0) = at.scale * m.per_log_sigma_s;
  j.col(1) = at.scale * m.per_sigma_a;
  if (scale_moves) j.col(2) = at.scale * m.l;
  return j;
}

ScatteringEquation::ScatteringEquation(const DenseSystem& system, const ScalePrior& scale,
                                       const ScatteringImage& pilot, const ScatteringPoint& at,
                                       double monte_carlo, CorrelatedErrors correlated)
    : system_(system), scale_(scale), correlated_(std::move(correlated)) {
  const Eigen::Index rows = system.l.size();
  if (pilot.l.size() != rows ||
      (correlated_.root.size() > 0 && correlated_.of_row.rows() != rows)) {
    throw std::invalid_argument("ScatteringEquation: image and system differ in rows");
  }
  row_variance_ = system.std_l.cwiseAbs2() + monte_carlo * at.scale * at.scale * pilot.variance;
  nuisances_ = system.nuisance_columns;
  if (nuisances_.size() == 0) nuisances_.resize(rows, 0);
  for (Eigen::Index i = 0; i < nuisances_.cols(); ++i) {
    const double std = system.nuisances[static_cast<std::size_t>(i)].std;
    // A free nuisance: far wider than anything the rows could leave undetermined.
    constexpr double kWide = 1e3;
    const double size = nuisances_.col(i).norm();
    nuisances_.col(i) *=
        std::isfinite(std) ? std : (size > 0.0 ? kWide * system.l.norm() / size : 0.0);
  }
  for (const Nuisance& v : system.nuisances) causes_.push_back(v.group);
  if (scale.relative_std > 0.0 && std::isfinite(scale.relative_std)) {
    nuisances_.conservativeResize(rows, nuisances_.cols() + 1);
    nuisances_.rightCols(1) = scale.relative_std * at.scale * pilot.l;
    causes_.push_back("scale");
  }
  const Eigen::Index own = nuisances_.cols(), all = own + correlated_.root.cols();
  Eigen::MatrixXd capacitance = Eigen::MatrixXd::Identity(all, all);
  const Eigen::MatrixXd by_nuisances =
      in_columns(row_variance_.cwiseInverse().asDiagonal() * nuisances_);
  capacitance.leftCols(own) += by_nuisances;
  if (all > own) {
    capacitance.topRightCorner(own, all - own) = by_nuisances.bottomRows(all - own).transpose();
    const SparseRows& of_row = correlated_.of_row;
    const Eigen::MatrixXd groups = SparseRows(of_row.transpose()) *
                                   SparseRows(row_variance_.cwiseInverse().asDiagonal() * of_row);
    capacitance.bottomRightCorner(all - own, all - own) +=
        correlated_.root.transpose() * groups * correlated_.root;
  }
  capacitance_ = inverse_lu(capacitance);
  const Eigen::MatrixXd z = jacobian(pilot, at, !std::isfinite(scale.relative_std));
  relative_size_ = z.colwise().norm() / (at.scale * pilot.l.norm());
  // A change of sigma_s counts even if it hardly affects the image.
  relative_size_[0] = std::max(relative_size_[0], 1.0);
  projection_.resize(z.cols(), rows);
  for (Eigen::Index k = 0; k < z.cols(); ++k) {
    projection_.row(k) = solve_covariance(z.col(k)).transpose();
  }
  per_log_scale_ = at.scale * pilot.l;
  if (z.cols() > 2) return;
  const Eigen::RowVectorXd direct = solve_covariance(per_log_scale_).transpose();
  const Eigen::RowVectorXd form = direct - (projection_ * per_log_scale_).transpose() *
                                               inverse_lu(projection_ * z) * projection_;
  const double information = form.dot(per_log_scale_);
  constexpr double kRounding = 1e-9;
  if (information > kRounding * direct.dot(per_log_scale_)) scale_form_ = form / information;
}

Eigen::MatrixXd ScatteringEquation::in_columns(const Eigen::MatrixXd& rows) const {
  Eigen::MatrixXd out(nuisances_.cols() + correlated_.root.cols(), rows.cols());
  out.topRows(nuisances_.cols()) = nuisances_.transpose() * rows;
  if (correlated_.root.size() > 0) {
    out.bottomRows(correlated_.root.cols()) =
        correlated_.root.transpose() * (correlated_.of_row.transpose() * rows);
  }
  return out;
}

Eigen::VectorXd ScatteringEquation::in_rows(const Eigen::VectorXd& columns) const {
  Eigen::VectorXd out = nuisances_ * columns.head(nuisances_.cols());
  if (correlated_.root.size() > 0) {
    out += correlated_.of_row * (correlated_.root * columns.tail(correlated_.root.cols()));
  }
  return out;
}

Eigen::VectorXd ScatteringEquation::solve_covariance(const Eigen::VectorXd& rows) const {
  const Eigen::VectorXd direct = rows.cwiseQuotient(row_variance_);
  return direct - in_rows(capacitance_ * in_columns(direct)).cwiseQuotient(row_variance_);
}

ScatteringEquation::Step ScatteringEquation::step(const ScatteringImage& m,
                                                  const Eigen::MatrixXd& projected_covariance,
                                                  const ScatteringPoint& at, double scatter) const {
  const Eigen::Index n = projection_.rows();
  const Eigen::MatrixXd slope = projection_ * jacobian(m, at, n == 3);
  const Eigen::VectorXd misfit = projection_ * (system_.l - at.scale * m.l);
  const Eigen::MatrixXd inverse = inverse_lu(slope);
  Step out;
  out.move = inverse * misfit;
  out.inverse = inverse;
  out.size = relative_size_;
  const auto add = [&](const std::string& name, const Eigen::MatrixXd& of_projection) {
    out.causes.push_back({name, inverse * of_projection * inverse.transpose()});
  };
  add("noise", projection_ * system_.std_l.cwiseAbs2().asDiagonal() * projection_.transpose());
  const Eigen::MatrixXd monte_carlo = at.scale * at.scale * projected_covariance;
  add("Monte Carlo", monte_carlo);
  if (scatter > 1.0) add("scatter", (scatter - 1.0) * monte_carlo);
  out.common_causes = inverse * (projection_ * nuisances_);
  std::map<std::string, Eigen::MatrixXd> groups;
  for (Eigen::Index i = 0; i < nuisances_.cols(); ++i) {
    groups.try_emplace(causes_[static_cast<std::size_t>(i)], Eigen::MatrixXd::Zero(n, n))
        .first->second += out.common_causes.col(i) * out.common_causes.col(i).transpose();
  }
  for (const auto& [name, covariance] : groups) out.causes.push_back({name, covariance});
  out.covariance = Eigen::MatrixXd::Zero(n, n);
  for (const Step::Cause& cause : out.causes) out.covariance += cause.covariance;
  out.taken = out.move;
  const double below = at.sigma_a_per_mm + out.move[1];
  if (below < 0.0) out.taken -= below / out.covariance(1, 1) * out.covariance.col(1);
  // By its effect on the image: a small sigma_a affects light that has travelled far.
  out.change = out.taken.cwiseAbs().cwiseProduct(relative_size_).maxCoeff();
  constexpr double kMost = 0.4;
  const Eigen::VectorXd cut = std::min(1.0, kMost / out.change) * out.taken;
  out.to = {at.sigma_s_per_mm * std::exp(cut[0]), std::max(0.0, at.sigma_a_per_mm + cut[1]),
            n == 3 ? at.scale * std::exp(cut[2]) : at.scale};
  return out;
}

Eigen::VectorXd ScatteringEquation::residual(const ScatteringImage& m, const ScatteringPoint& at,
                                             const ScatteringPoint& to) const {
  return system_.l - to.scale * m.l -
         at.scale * (std::log(to.sigma_s_per_mm / at.sigma_s_per_mm) * m.per_log_sigma_s +
                     (to.sigma_a_per_mm - at.sigma_a_per_mm) * m.per_sigma_a);
}

ScatteringEquation::ScaleTest ScatteringEquation::scale_test(const Eigen::VectorXd& residual,
                                                             double form_variance,
                                                             double scatter) const {
  if (scale_form_.size() == 0) return {};
  double variance = scale_form_.cwiseAbs2().dot(system_.std_l.cwiseAbs2()) +
                    std::max(1.0, scatter) * form_variance;
  variance += (scale_form_ * nuisances_).squaredNorm();
  ScaleTest out;
  out.offset = scale_form_.dot(residual);
  out.std = std::sqrt(variance);
  const double chi2 = out.offset * out.offset / variance;
  if (std::isfinite(chi2)) out.p_value = chi_square_tail(chi2, 1.0);
  return out;
}

void ScatteringEquation::widen_by_scale(double offset, Step& step) const {
  const Eigen::VectorXd move = offset * (step.inverse * (projection_ * per_log_scale_));
  const Eigen::MatrixXd covariance = move * move.transpose();
  step.causes.push_back({"doubted scale", covariance});
  step.covariance += covariance;
}

double ScatteringEquation::settled_log_scale(const Eigen::VectorXd& residual) const {
  if (causes_.empty() || causes_.back() != "scale") return 0.0;
  return scale_.relative_std *
         nuisances_.col(nuisances_.cols() - 1).dot(solve_covariance(residual));
}

Eigen::VectorXd ScatteringEquation::without_nuisances(const Eigen::VectorXd& residual) const {
  return residual - nuisances_ * (nuisances_.transpose() * solve_covariance(residual));
}

}  // namespace scattermeter
