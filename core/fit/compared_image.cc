#include "core/fit/compared_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/chi_square.h"
#include "core/base/median.h"
#include "core/diffusion/dipole_curve.h"

namespace scattermeter {
namespace {

// Vectors of the shots, one below the other.
Eigen::VectorXd joined(const std::vector<ComparedImage>& shots,
                       const Eigen::VectorXd& (*part)(const ComparedImage&)) {
  Eigen::Index n = 0;
  for (const ComparedImage& shot : shots) n += part(shot).size();
  Eigen::VectorXd out(n);
  Eigen::Index at = 0;
  for (const ComparedImage& shot : shots) {
    out.segment(at, part(shot).size()) = part(shot);
    at += part(shot).size();
  }
  return out;
}

Eigen::MatrixXd stacked_rows(const std::vector<ComparedImage>& shots,
                             const Eigen::MatrixXd& (*part)(const ComparedImage&),
                             Eigen::Index cols) {
  Eigen::Index n = 0;
  for (const ComparedImage& shot : shots) n += part(shot).rows();
  Eigen::MatrixXd out(n, cols);
  Eigen::Index at = 0;
  for (const ComparedImage& shot : shots) {
    if (part(shot).rows() == 0) continue;
    out.middleRows(at, part(shot).rows()) = part(shot);
    at += part(shot).rows();
  }
  return out;
}

// scale * R and its derivatives by u, q and log scale, on the knots.
struct ScaledCurve {
  Eigen::VectorXd r;
  Eigen::MatrixXd by_unknowns;
};

ComparedParts parts_of(const ShotSystem& shot, const ScaledCurve& curve,
                       const Eigen::VectorXd& nominal, const Eigen::VectorXd& settled,
                       std::size_t n_nuisances) {
  ComparedParts out;
  const DenseSystem& system = *shot.system;
  const Eigen::Index rows = system.l.size();
  const int n_parts = *std::max_element(shot.part_of_row.begin(), shot.part_of_row.end()) + 1;
  Eigen::VectorXd light = Eigen::VectorXd::Zero(n_parts);
  for (Eigen::Index j = 0; j < rows; ++j) {
    light[shot.part_of_row[static_cast<std::size_t>(j)]] += system.l[j];
  }
  const auto summed = [&](const Eigen::MatrixXd& of_rows) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n_parts, of_rows.cols());
    for (Eigen::Index j = 0; j < rows; ++j) {
      sum.row(shot.part_of_row[static_cast<std::size_t>(j)]) += of_rows.row(j);
    }
    return Eigen::MatrixXd(light.cwiseInverse().asDiagonal() * sum);
  };
  out.residual = summed(system.l - nominal);
  const Eigen::VectorXd unscaled = summed(system.std_l.cwiseAbs2());
  out.std = unscaled.cwiseQuotient(light).cwiseSqrt();
  out.free = summed(system.weights * curve.by_unknowns);
  out.columns = Eigen::MatrixXd::Zero(n_parts, static_cast<Eigen::Index>(n_nuisances));
  if (!shot.nuisances.empty()) {
    out.columns(Eigen::all, shot.nuisances) = summed(system.nuisance_columns);
  }
  const Eigen::VectorXd rest = (system.l - settled).cwiseQuotient(system.std_l);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(n_parts);
  Eigen::VectorXd sum = count, squares = count;
  for (Eigen::Index j = 0; j < rows; ++j) {
    const int part = shot.part_of_row[static_cast<std::size_t>(j)];
    count[part] += 1.0;
    sum[part] += rest[j];
    squares[part] += rest[j] * rest[j];
  }
  out.scatter_dof = (count.array() - 1.0).matrix();
  out.scatter_chi2 = squares - sum.cwiseAbs2().cwiseQuotient(count);
  return out;
}

}  // namespace

ComparedImage compared_image(const ImageRows& rows, const DistanceKnots& knots,
                             const DipoleSolver::Point& point, double eta_int_over_ext) {
  const DipoleCurve curve = dipole_curve(knots, point.u, point.q, eta_int_over_ext);
  const double scale = std::exp(point.log_s);
  ScaledCurve scaled{scale * curve.r, Eigen::MatrixXd(curve.r.size(), 3)};
  scaled.by_unknowns << scale * curve.d_u, scale * curve.d_q, scale * curve.r;
  std::vector<ComparedImage> shots(rows.shots());
  for_each_shot(rows, [&](std::size_t s, const ShotSystem& shot) {
    ComparedImage& out = shots[s];
    out.l = shot.system->l;
    out.std_l = shot.system->std_l;
    const Eigen::VectorXd nominal = shot.system->weights * scaled.r;
    out.predicted = nominal;
    for (std::size_t k = 0; k < shot.nuisances.size(); ++k) {
      const auto v = static_cast<std::size_t>(shot.nuisances[k]);
      if (v >= point.v.size()) continue;  // held
      out.predicted += point.v[v] * shot.system->nuisance_columns.col(static_cast<Eigen::Index>(k));
    }
    out.neighbours =
        squares_of_sums(shot.cell_of_row, (out.l - out.predicted).cwiseQuotient(out.std_l));
    if (shot.part_of_row.empty()) return;
    out.parts = parts_of(shot, scaled, nominal, out.predicted, rows.nuisances().size());
  });
  using Image = const ComparedImage&;
  ComparedImage out;
  out.predicted = joined(shots, [](Image i) -> const Eigen::VectorXd& { return i.predicted; });
  out.l = joined(shots, [](Image i) -> const Eigen::VectorXd& { return i.l; });
  out.std_l = joined(shots, [](Image i) -> const Eigen::VectorXd& { return i.std_l; });
  for (const ComparedImage& shot : shots) {
    out.neighbours.squares += shot.neighbours.squares;
    out.neighbours.cells += shot.neighbours.cells;
  }
  ComparedParts& parts = out.parts;
  parts.residual =
      joined(shots, [](Image i) -> const Eigen::VectorXd& { return i.parts.residual; });
  parts.std = joined(shots, [](Image i) -> const Eigen::VectorXd& { return i.parts.std; });
  parts.scatter_chi2 =
      joined(shots, [](Image i) -> const Eigen::VectorXd& { return i.parts.scatter_chi2; });
  parts.scatter_dof =
      joined(shots, [](Image i) -> const Eigen::VectorXd& { return i.parts.scatter_dof; });
  parts.free = stacked_rows(
      shots, [](Image i) -> const Eigen::MatrixXd& { return i.parts.free; }, 3);
  parts.columns = stacked_rows(
      shots, [](Image i) -> const Eigen::MatrixXd& { return i.parts.columns; },
      static_cast<Eigen::Index>(rows.nuisances().size()));
  return out;
}

LackOfFit misfit_of_parts(const ComparedParts& parts, const std::vector<Nuisance>& nuisances,
                          const ScalePrior& scale) {
  const Eigen::Index n = parts.residual.size();
  std::vector<double> scatter;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (parts.scatter_dof[k] > 0.0) scatter.push_back(parts.scatter_chi2[k] / parts.scatter_dof[k]);
  }
  const bool scale_is_free = std::isinf(scale.relative_std);
  const int unknowns = scale_is_free ? 3 : 2;
  int fitted = unknowns;
  for (const Nuisance& v : nuisances) fitted += std::isinf(v.std) ? 1 : 0;
  if (scatter.empty() || n <= fitted) return {};
  const double noise = std::max(1.0, upper_median(scatter));
  constexpr double kWide = 30.0;  // of the light
  const auto wide = [&](const Eigen::VectorXd& column) {
    const double most = column.cwiseAbs().maxCoeff();
    return Eigen::VectorXd(most > 0.0 ? kWide / most * column : column);
  };
  Eigen::MatrixXd free(n, 3 + parts.columns.cols());
  free.col(0) = wide(parts.free.col(0));
  free.col(1) = wide(parts.free.col(1));
  free.col(2) = scale_is_free ? wide(parts.free.col(2))
                              : Eigen::VectorXd(scale.relative_std * parts.free.col(2));
  for (Eigen::Index k = 0; k < parts.columns.cols(); ++k) {
    const double std = nuisances[static_cast<std::size_t>(k)].std;
    free.col(3 + k) = std::isinf(std) ? wide(parts.columns.col(k)) : std * parts.columns.col(k);
  }
  return lack_of_fit(parts.residual, noise * parts.std.cwiseAbs2().asDiagonal().toDenseMatrix(),
                     free, fitted);
}

LackOfFit misfit_of_cells(const ComparedImage& image) {
  LackOfFit out;
  out.chi2 = image.neighbours.squares;
  out.dof = std::max(1.0, image.neighbours.cells);
  out.p_value = chi_square_tail(out.chi2, out.dof);
  // A shared variance of c times the rows' adds as many times c as a cell has rows.
  const double rows_of_cell = static_cast<double>(image.l.size()) / out.dof;
  const double shared = std::max(0.0, out.chi2 / out.dof - 1.0) / std::max(1.0, rows_of_cell);
  out.rms = std::sqrt(shared) * image.std_l.norm() / image.l.norm();
  return out;
}

}  // namespace scattermeter
