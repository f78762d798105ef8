#include "core/fit/scattering_equation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include <oneapi/tbb/parallel_for.h>

#include "core/base/chi_square.h"
#include "core/base/dense_solve.h"

namespace scattermeter {
namespace {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

bool has_prior(const ScalePrior& scale) { return scale.relative_std > 0.0 && !scale.is_free(); }

// x of a * x = b, for a positive matrix whose rows differ in units and may be all but dependent.
Eigen::VectorXd solve_positive(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  constexpr double kRidge = 1e-9;
  const Eigen::VectorXd unit =
      a.diagonal().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd scaled = unit.asDiagonal() * a * unit.asDiagonal();
  scaled.diagonal().array() += kRidge;
  return unit.cwiseProduct(solve_lu(scaled, unit.cwiseProduct(b)));
}

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
                                       std::vector<EquationPilot> pilots, const ScatteringPoint& at,
                                       double monte_carlo)
    : system_(system), scale_(scale) {
  if (pilots.empty() || pilots.size() > 2) {
    throw std::invalid_argument("ScatteringEquation: one or two pilots are needed");
  }
  for (const Nuisance& v : system.nuisances) causes_.push_back(v.group);
  if (has_prior(scale)) causes_.push_back("scale");
  std::array<std::optional<Weights>, 2> of_half;
  tbb::parallel_for(std::size_t{0}, pilots.size(), [&](std::size_t half) {
    of_half[half].emplace(system, scale, std::move(pilots[half]), at, monte_carlo);
  });
  for (std::optional<Weights>& weights : of_half) {
    if (weights) weights_.push_back(std::move(*weights));
  }
}

ScatteringEquation::Weights::Weights(const DenseSystem& system, const ScalePrior& scale,
                                     EquationPilot pilot, const ScatteringPoint& at,
                                     double monte_carlo)
    : errors(std::move(pilot.errors)) {
  const ScatteringImage& image = pilot.image;
  const Eigen::Index rows = system.l.size();
  if (image.l.size() != rows || (errors.root.size() > 0 && errors.of_row.rows() != rows)) {
    throw std::invalid_argument("ScatteringEquation: image and system differ in rows");
  }
  row_variance = system.std_l.cwiseAbs2() + monte_carlo * at.scale * at.scale * image.variance;
  nuisances = system.nuisance_columns;
  if (nuisances.size() == 0) nuisances.resize(rows, 0);
  for (Eigen::Index i = 0; i < nuisances.cols(); ++i) {
    const double std = system.nuisances[static_cast<std::size_t>(i)].std;
    // A free nuisance: far wider than anything the rows could leave undetermined.
    constexpr double kWide = 1e3;
    const double size = nuisances.col(i).norm();
    nuisances.col(i) *=
        std::isfinite(std) ? std : (size > 0.0 ? kWide * system.l.norm() / size : 0.0);
  }
  per_log_scale = at.scale * image.l;
  if (has_prior(scale)) {
    nuisances.conservativeResize(rows, nuisances.cols() + 1);
    nuisances.rightCols(1) = scale.relative_std * per_log_scale;
  }
  const Eigen::Index own = nuisances.cols(), all = own + errors.root.cols();
  Eigen::MatrixXd c = Eigen::MatrixXd::Identity(all, all);
  const Eigen::VectorXd precision = row_variance.cwiseInverse();
  c.topLeftCorner(own, own).selfadjointView<Eigen::Lower>().rankUpdate(
      Eigen::MatrixXd(precision.cwiseSqrt().asDiagonal() * nuisances).transpose());
  if (all > own) {
    const SparseRows weighted = precision.asDiagonal() * errors.of_row;
    c.bottomLeftCorner(all - own, own) =
        errors.root.transpose() * (weighted.transpose() * nuisances);
    c.bottomRightCorner(all - own, all - own) +=
        errors.root.transpose() * SparseRows(errors.of_row.transpose() * weighted) * errors.root;
  }
  c.triangularView<Eigen::StrictlyUpper>() = c.transpose();
  capacitance = inverse_lu(c);
  const Eigen::MatrixXd z = jacobian(image, at, scale.is_free());
  relative_size = z.colwise().norm() / (at.scale * image.l.norm());
  // A change of sigma_s counts even if it hardly affects the image.
  relative_size[0] = std::max(relative_size[0], 1.0);
  Eigen::MatrixXd instruments(rows, z.cols() + pilot.further.cols());
  instruments.leftCols(z.cols()) = z;
  instruments.rightCols(pilot.further.cols()) = pilot.further;
  projection = solve_covariance(instruments).transpose();
  gram = projection * instruments;
  of_nuisances = projection * nuisances;
  expected = std::move(pilot.expected);
  // In the mean over the rows, a departure from what is expected is of this share of a derivative.
  constexpr double kSpread = 0.5;
  inverse_spread = instruments.colwise().squaredNorm().transpose() *
                   (kSpread * kSpread * z.colwise().squaredNorm()).cwiseInverse();
  if (z.cols() > 2) return;
  const Eigen::RowVectorXd direct = solve_covariance(per_log_scale).transpose();
  const auto own_projection = projection.topRows(z.cols());
  const Eigen::RowVectorXd form = direct - (own_projection * per_log_scale).transpose() *
                                               inverse_lu(own_projection * z) * own_projection;
  const double information = form.dot(per_log_scale);
  constexpr double kRounding = 1e-9;
  if (information > kRounding * direct.dot(per_log_scale)) scale_form = form / information;
}

Eigen::MatrixXd ScatteringEquation::Weights::in_columns(const Eigen::MatrixXd& rows) const {
  Eigen::MatrixXd out(nuisances.cols() + errors.root.cols(), rows.cols());
  out.topRows(nuisances.cols()) = nuisances.transpose() * rows;
  if (errors.root.size() > 0) {
    out.bottomRows(errors.root.cols()) =
        errors.root.transpose() * (errors.of_row.transpose() * rows);
  }
  return out;
}

Eigen::MatrixXd ScatteringEquation::Weights::in_rows(const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd out = nuisances * columns.topRows(nuisances.cols());
  if (errors.root.size() > 0) {
    out += errors.of_row * (errors.root * columns.bottomRows(errors.root.cols()));
  }
  return out;
}

Eigen::MatrixXd ScatteringEquation::Weights::solve_covariance(const Eigen::MatrixXd& rows) const {
  const Eigen::DiagonalMatrix<double, Eigen::Dynamic> inverse(row_variance.cwiseInverse());
  const Eigen::MatrixXd direct = inverse * rows;
  return direct - inverse * in_rows(capacitance * in_columns(direct));
}

Eigen::MatrixXd ScatteringEquation::Weights::mixing(const Eigen::MatrixXd& seen,
                                                    const Eigen::MatrixXd& by_other) const {
  const Eigen::Index n = seen.cols(), k = seen.rows();
  if (k == n) return Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd apart = seen - by_other;
  Eigen::MatrixXd out(n, k);
  for (Eigen::Index u = 0; u < n; ++u) {
    // The variance of the derivatives of one half, over that of its light.
    const double noise =
        apart.col(u).dot(solve_positive(gram, apart.col(u))) / (2.0 * static_cast<double>(k));
    const Eigen::VectorXd prior = noise * inverse_spread.col(u);
    out.row(u) = solve_positive(gram + Eigen::MatrixXd(prior.asDiagonal()),
                                seen.col(u) + prior.cwiseProduct(expected.col(u)))
                     .transpose();
  }
  return out;
}

ScatteringEquation::Step ScatteringEquation::step(const PathHalves& m,
                                                  const Eigen::MatrixXd& projected_covariance,
                                                  const ScatteringPoint& at, double scatter) const {
  const Eigen::Index n = unknowns();
  // Instruments x unknowns: the derivatives by the paths of a half, and by those of the other.
  std::array<Eigen::MatrixXd, 2> seen, by_other;
  for (std::size_t half = 0; half < 2; ++half) {
    const Eigen::MatrixXd derivatives = jacobian(m[half], at, n == 3);
    seen[half] = projection(half) * derivatives;
    by_other[1 - half] = projection(1 - half) * derivatives;
  }
  const std::array<Eigen::MatrixXd, 2> mix = {of(1).mixing(seen[1], by_other[1]),
                                              of(0).mixing(seen[0], by_other[0])};
  const Eigen::MatrixXd slope = 0.5 * (mix[0] * seen[0] + mix[1] * seen[1]);
  const Eigen::VectorXd misfit = mean([&](const Weights& w, std::size_t half) -> Eigen::MatrixXd {
    return mix[half] * (w.projection * (system_.l - at.scale * m[half].l));
  });
  Step out;
  out.promised = inverse_lu(slope);
  out.move = out.promised * misfit;
  out.inverse = 0.5 * out.promised * (mix[0] + mix[1]);
  out.size = weights_.front().relative_size;
  const auto add = [&](const std::string& name, const Eigen::MatrixXd& of_misfit) {
    out.causes.push_back({name, out.promised * of_misfit * out.promised.transpose()});
  };
  const Eigen::MatrixXd both = mean([&](const Weights& w, std::size_t half) -> Eigen::MatrixXd {
    return mix[half] * w.projection;
  });
  add("noise", both * system_.std_l.cwiseAbs2().asDiagonal() * both.transpose());
  // The halves' errors are alike and independent.
  const Eigen::MatrixXd monte_carlo =
      at.scale * at.scale * mean([&](const Weights&, std::size_t half) -> Eigen::MatrixXd {
        return mix[half] * projected_covariance * mix[half].transpose();
      });
  add("Monte Carlo", monte_carlo);
  if (scatter > 1.0) add("scatter", (scatter - 1.0) * monte_carlo);
  out.common_causes =
      out.promised * mean([&](const Weights& w, std::size_t half) -> Eigen::MatrixXd {
        return mix[half] * w.of_nuisances;
      });
  if (const Eigen::Index k = system_.beyond_column.nuisance; k >= 0) {
    const double std = system_.nuisances[static_cast<std::size_t>(k)].std;
    const Eigen::VectorXd moved = std * out.promised * both * system_.beyond_column.l;
    out.common_causes.col(k) += moved;
    out.promised += moved * moved.transpose();
  }
  std::map<std::string, Eigen::MatrixXd> groups;
  for (Eigen::Index i = 0; i < out.common_causes.cols(); ++i) {
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
  out.change = out.taken.cwiseAbs().cwiseProduct(out.size).maxCoeff();
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

ScatteringEquation::ScaleTest ScatteringEquation::scale_test(
    const std::array<Eigen::VectorXd, 2>& residuals, double form_variance, double scatter) const {
  if (of(0).scale_form.size() == 0 || of(1).scale_form.size() == 0) return {};
  const Eigen::RowVectorXd form =
      mean([](const Weights& w, std::size_t) -> Eigen::MatrixXd { return w.scale_form; });
  double variance =
      form.cwiseAbs2().dot(system_.std_l.cwiseAbs2()) + std::max(1.0, scatter) * form_variance;
  variance += mean([](const Weights& w, std::size_t) -> Eigen::MatrixXd {
                return w.scale_form * w.nuisances;
              }).squaredNorm();
  ScaleTest out;
  out.offset = 0.5 * (of(0).scale_form.dot(residuals[0]) + of(1).scale_form.dot(residuals[1]));
  out.std = std::sqrt(variance);
  const double chi2 = out.offset * out.offset / variance;
  if (std::isfinite(chi2)) out.p_value = chi_square_tail(chi2, 1.0);
  return out;
}

void ScatteringEquation::widen_by_scale(double offset, Step& step) const {
  const Eigen::VectorXd move =
      offset * (step.inverse * mean([](const Weights& w, std::size_t) -> Eigen::MatrixXd {
                  return w.projection * w.per_log_scale;
                }));
  const Eigen::MatrixXd covariance = move * move.transpose();
  step.causes.push_back({"doubted scale", covariance});
  step.covariance += covariance;
}

double ScatteringEquation::settled_log_scale(const Eigen::VectorXd& residual) const {
  if (!has_prior(scale_)) return 0.0;
  const Weights& w = weights_.front();
  return scale_.relative_std *
         w.nuisances.col(w.nuisances.cols() - 1).dot(w.solve_covariance(residual).col(0));
}

Eigen::VectorXd ScatteringEquation::without_nuisances(const Eigen::VectorXd& residual) const {
  const Weights& w = weights_.front();
  return residual - w.nuisances * (w.nuisances.transpose() * w.solve_covariance(residual));
}

}  // namespace scattermeter
