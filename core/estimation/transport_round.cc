#include "core/estimation/transport_round.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <oneapi/tbb/parallel_for.h>

#include "core/base/dense_solve.h"
#include "core/estimation/transport_pilot.h"
#include "core/fit/excess_scatter.h"
#include "core/fit/part_light.h"

namespace scattermeter {
namespace {

ScatteringImage part_of(const ScatteringImage& m, Eigen::Index first, Eigen::Index n) {
  return {m.l.segment(first, n), m.per_log_sigma_s.segment(first, n),
          m.per_sigma_a.segment(first, n),
          m.variance.size() > 0 ? m.variance.segment(first, n) : Eigen::VectorXd()};
}

// Of `n` rows from the `first` on.
std::vector<EquationPilot> pilots_of(const ShotParts& parts, const ScatteringPoint& at,
                                     bool is_free,
                                     const std::array<TransportRound::Pilot, 2>& pilots,
                                     const std::array<Eigen::MatrixXd, 2>& further,
                                     Eigen::Index first, Eigen::Index n) {
  std::vector<EquationPilot> out;
  for (std::size_t half = 0; half < 2; ++half) {
    const ScatteringImage& image = pilots[half].image;
    out.push_back({part_of(image, first, n),
                   correlated_rows(parts, at.scale * image.l, pilots[half].cells, first, n),
                   further[half].middleRows(first, n), expected_coefficients(is_free)});
  }
  return out;
}

}  // namespace

TransportRound::TransportRound(const TransportShots& shots, const ScalePrior& scale,
                               const ScatteringPoint& at, const std::array<Pilot, 2>& pilots,
                               double expected)
    : TransportRound(shots, scale, at, pilots,
                     {further_images(shots.parts, pilots[0].image, scale.is_free()),
                      further_images(shots.parts, pilots[1].image, scale.is_free())},
                     expected) {}

TransportRound::TransportRound(const TransportShots& shots, const ScalePrior& scale,
                               const ScatteringPoint& at, const std::array<Pilot, 2>& pilots,
                               const std::array<Eigen::MatrixXd, 2>& further, double expected)
    : shots_(shots),
      scale_(scale),
      at_(at),
      pilot_(mean_of(pilots[0].image, pilots[1].image)),
      joint_(shots.system, scale,
             pilots_of(shots.parts, at, scale.is_free(), pilots, further, 0, shots.system.l.size()),
             at, expected) {
  const std::vector<Eigen::Index>& shot_rows = shots.system.shot_rows;
  if (shot_rows.size() < 2) return;
  Eigen::Index first = 0;
  for (std::size_t s = 0; s < shot_rows.size(); ++s) {
    if (shot_rows[s] >= kLeastRows) singles_.push_back({s, first, {}, {}});
    first += shot_rows[s];
  }
  tbb::parallel_for(std::size_t{0}, singles_.size(), [&](std::size_t i) {
    Single& single = singles_[i];
    const Eigen::Index n = shot_rows[single.shot];
    std::vector<Eigen::Index> rows(static_cast<std::size_t>(n));
    std::iota(rows.begin(), rows.end(), single.first);
    single.system = selected(shots.system, rows);
    single.equation.emplace(
        single.system, scale,
        pilots_of(shots.parts, at, scale.is_free(), pilots, further, single.first, n), at,
        expected);
  });
}

bool TransportRound::tests_scale() const {
  return joint_.scale_form(0).size() > 0 && joint_.scale_form(1).size() > 0;
}

ChannelSimulation::Projections TransportRound::projections() const {
  return {projection(0), projection(1)};
}

Eigen::SparseMatrix<double> TransportRound::projection(std::size_t half) const {
  const Eigen::Index n_cells = shots_.parts.n_cells();
  const Eigen::Index n_estimates = instruments() * (1 + static_cast<Eigen::Index>(singles_.size()));
  const Eigen::Index before_cells = n_estimates + (tests_scale() ? 1 : 0);
  std::vector<Eigen::Triplet<double>> values;
  const auto add = [&](Eigen::Index to, Eigen::Index first, const Eigen::MatrixXd& block) {
    for (Eigen::Index j = 0; j < block.cols(); ++j) {
      for (Eigen::Index i = 0; i < block.rows(); ++i) {
        values.emplace_back(to + i, first + j, block(i, j));
      }
    }
  };
  add(0, 0, joint_.projection(half));
  for (std::size_t i = 0; i < singles_.size(); ++i) {
    add(static_cast<Eigen::Index>(i + 1) * instruments(), singles_[i].first,
        singles_[i].equation->projection(half));
  }
  if (tests_scale()) add(n_estimates, 0, joint_.scale_form(half));
  for (Eigen::Index c = 0; c < n_cells; ++c) {
    for (ShotParts::Sums::InnerIterator it(shots_.parts.cells(), c); it; ++it) {
      values.emplace_back(before_cells + c, it.col(), it.value());
    }
  }
  Eigen::SparseMatrix<double> all(before_cells + n_cells, shots_.system.l.size());
  all.setFromTriplets(values.begin(), values.end());
  return all;
}

Eigen::MatrixXd TransportRound::covariance_between(Eigen::Index a, Eigen::Index b) const {
  return variance_by_learning(blocks()) *
         look_.covariance.block(a * instruments(), b * instruments(), instruments(), instruments());
}

void TransportRound::take(ChannelSimulation::Look look) {
  look_ = std::move(look);
  const DenseSystem::BeyondColumn& beyond = shots_.system.beyond_column;
  for (Single& single : singles_) {
    const Eigen::Index n = single.system.l.size();
    if (beyond.nuisance >= 0) single.system.beyond_column.l = beyond.l.segment(single.first, n);
  }
  const Eigen::MatrixXd own = covariance_between(0, 0);
  step_ = joint_.step(look_.halves, own, at_);
  // Smoothed images, such as renderings, scatter less from row to row than over several rows; both
  // are noise. Offsets of whole parts are not.
  const Eigen::VectorXd rest = residual();
  const Eigen::VectorXd settled = joint_.without_nuisances(rest);
  const Eigen::VectorXd noise = shots_.system.std_l.cwiseAbs2();
  const Eigen::VectorXd paths = at_.scale * at_.scale * image().variance;
  const Eigen::VectorXd weights = joint_.row_variance().cwiseInverse();
  unexplained_ = std::sqrt(std::max(0.0, (settled.cwiseAbs2() - noise - paths).mean()) /
                           shots_.system.l.cwiseAbs2().mean());
  scatter_within_ =
      std::max(std::min(excess_scatter(settled, noise, paths, weights),
                        most_scatter(kMostRowScatter, shots_.system.l, paths, weights)),
               scatter_of_cells(rest));
  scatter_ = scatter_within_;
  misfit_ = misfit_of(rest);
  if (misfit_.p_value < kWideningPValue) scatter_ *= std::max(1.0, misfit_.chi2 / misfit_.dof);
  step_ = joint_.step(look_.halves, own, at_, scatter_);
  const bool is_precise_now = is_precise(step_, at_.sigma_a_per_mm, blocks());
  if (precise_blocks_ == 0 && is_precise_now) precise_blocks_ = blocks();
}

Eigen::VectorXd TransportRound::row_variance(const std::vector<double>& area_mm2,
                                             double scatter) const {
  return shots_.system.std_l.cwiseAbs2() +
         scatter * at_.scale * at_.scale *
             smooth_path_variance(pilot_.l, area_mm2, image().variance);
}

ScatteringEquation::ScaleTest TransportRound::scale_test() const {
  if (!tests_scale()) return {};
  const Eigen::MatrixXd& covariance = look_.covariance;
  const Eigen::Index row = covariance.rows() - shots_.parts.n_cells() - 1;
  return joint_.scale_test({joint_.residual(look_.halves[0], at_, step_.to),
                            joint_.residual(look_.halves[1], at_, step_.to)},
                           at_.scale * at_.scale * covariance(row, row), scatter_);
}

Eigen::MatrixXd TransportRound::of_cells(const Eigen::MatrixXd& covariance) const {
  const Eigen::Index n = shots_.parts.n_cells();
  return covariance.bottomRightCorner(n, n);
}

// Among the cells of each part, about its own light.
double TransportRound::scatter_of_cells(const Eigen::VectorXd& rest) const {
  if (blocks() < kLeastBlocks) return 1.0;
  const ShotParts::Sums& about = shots_.parts.about_parts();
  const ShotParts::Sums light = about * shots_.parts.cells();
  const Eigen::VectorXd paths =
      at_.scale * at_.scale *
      Eigen::MatrixXd(about * cell_covariance() * about.transpose()).diagonal();
  const Eigen::VectorXd noise = light.cwiseAbs2() * shots_.system.std_l.cwiseAbs2();
  // A part that is one cell does not contribute.
  const Eigen::VectorXd weights =
      (paths.array() > 1e-9 * paths.maxCoeff()).select(paths.cwiseInverse(), 0.0);
  return std::min(
      excess_scatter(light * rest, noise, paths, weights),
      most_scatter(kMostCellScatter, Eigen::VectorXd::Ones(paths.size()), paths, weights));
}

std::vector<std::size_t> TransportRound::shots() const {
  std::vector<std::size_t> out;
  for (const Single& single : singles_) out.push_back(single.shot);
  return out;
}

std::vector<ScatteringEquation::Step> TransportRound::steps_of_shots() const {
  std::vector<ScatteringEquation::Step> steps;
  for (std::size_t i = 0; i < singles_.size(); ++i) {
    const auto own = static_cast<Eigen::Index>(i + 1);
    const auto part = [&, first = singles_[i].first](std::size_t half) {
      return part_of(look_.halves[half], first, singles_[i].system.l.size());
    };
    steps.push_back(singles_[i].equation->step({part(0), part(1)}, covariance_between(own, own),
                                               at_, scatter_));
  }
  return steps;
}

ShotAgreement TransportRound::agreement(const std::vector<ScatteringEquation::Step>& steps) const {
  const auto n = static_cast<Eigen::Index>(steps.size());
  Eigen::VectorXd estimates(2 * n);
  Eigen::MatrixXd all(2 * n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ScatteringEquation::Step& a = steps[static_cast<std::size_t>(i)];
    estimates.segment<2>(2 * i) = a.move.head<2>();
    all.block<2, 2>(2 * i, 2 * i) = a.covariance.topLeftCorner<2, 2>();
    for (Eigen::Index k = 0; k < i; ++k) {
      const ScatteringEquation::Step& b = steps[static_cast<std::size_t>(k)];
      // Shots under the same light share paths.
      const Eigen::MatrixXd paths = at_.scale * at_.scale * covariance_between(i + 1, k + 1);
      const Eigen::MatrixXd shared =
          a.common_causes * b.common_causes.transpose() + a.inverse * paths * b.inverse.transpose();
      all.block<2, 2>(2 * i, 2 * k) = shared.topLeftCorner<2, 2>();
      all.block<2, 2>(2 * k, 2 * i) = shared.topLeftCorner<2, 2>().transpose();
    }
  }
  return agreement_of(estimates, all);
}

Eigen::MatrixXd TransportRound::covariance_of_parts(const ShotParts::Sums& light) const {
  const Eigen::Index n = light.rows();
  const ShotParts::Sums weighted = light * shots_.system.std_l.cwiseAbs2().asDiagonal();
  const Eigen::MatrixXd noise = ShotParts::Sums(weighted * light.transpose());
  // The inverse of a covariance from so few batches is too large in the mean (Hartlap, Simon &
  // Schneider 2007); parts of other shots do not count.
  const double own_parts =
      static_cast<double>(n) / static_cast<double>(shots_.system.shot_rows.size());
  const double too_large = look_.freedom / std::max(1.0, look_.freedom - own_parts - 1.0);
  return noise + at_.scale * at_.scale * scatter_within_ * too_large *
                     (shots_.parts.parts() * cell_covariance() * shots_.parts.parts().transpose());
}

LackOfFit TransportRound::misfit_of(const Eigen::VectorXd& rest) const {
  if (blocks() < kLeastBlocks) return {};
  const ShotParts::Sums light = shots_.parts.parts() * shots_.parts.cells();
  const Eigen::Index n = light.rows();
  const Eigen::MatrixXd j = light * ScatteringEquation::jacobian(pilot_, at_, unknowns() == 3);
  Eigen::MatrixXd free(n, j.cols() + joint_.nuisances().cols());
  constexpr double kWide = 30.0;  // of the light
  for (Eigen::Index k = 0; k < j.cols(); ++k) {
    free.col(k) = kWide / j.col(k).cwiseAbs().maxCoeff() * j.col(k);
  }
  free.rightCols(joint_.nuisances().cols()) = light * joint_.nuisances();
  const auto unbound = std::count_if(shots_.system.nuisances.begin(), shots_.system.nuisances.end(),
                                     [](const Nuisance& v) { return !std::isfinite(v.std); });
  const int fitted = static_cast<int>(j.cols() + unbound);
  if (n <= fitted) return {};
  return lack_of_fit(light * rest, covariance_of_parts(light), free, fitted);
}

ModelJudgement TransportRound::judgement() const {
  if (blocks() < kLeastBlocks) return {};
  const ShotParts::Sums light = shots_.parts.parts() * shots_.parts.cells();
  const Eigen::MatrixXd root = cholesky_lower(covariance_of_parts(light));
  if (!root.allFinite()) return {};
  const auto whitened = [&](const Eigen::MatrixXd& of_rows) -> Eigen::MatrixXd {
    return root.triangularView<Eigen::Lower>().solve(light * of_rows);
  };
  const bool is_free = unknowns() == 3;
  const auto n = static_cast<Eigen::Index>(shots_.system.nuisances.size());
  WhitenedModel model;
  model.residual = whitened(residual());
  model.free = whitened(ScatteringEquation::jacobian(pilot_, at_, is_free));
  model.free.col(0) /= at_.sigma_s_per_mm;
  model.columns.resize(light.rows(), n + (is_free ? 0 : 1));
  if (n > 0) model.columns.leftCols(n) = whitened(shots_.system.nuisance_columns);
  model.nuisances = shots_.system.nuisances;
  if (!is_free) {
    model.columns.rightCols(1) = whitened(at_.scale * pilot_.l);
    model.nuisances.push_back({"scale", scale_.relative_std, true, "scale"});
  }
  model.data_length = whitened(shots_.system.l).norm();
  ModelJudgement out = judge(model);
  // The estimate rests on rows, whose weights are not those of the parts.
  for (PriorPull& pull : out.pulls) {
    const auto of_pull = std::find_if(model.nuisances.begin(), model.nuisances.end(),
                                      [&](const Nuisance& v) { return v.name == pull.name; });
    if (of_pull - model.nuisances.begin() >= step_.common_causes.cols()) continue;  // exact scale
    set_unseen(step_.common_causes.col(of_pull - model.nuisances.begin()), at_.sigma_s_per_mm,
               pull);
  }
  return out;
}

bool TransportRound::has_enough_paths() const {
  constexpr int kMoreInDoubt = 4;
  if (!is_precise(step_, at_.sigma_a_per_mm, blocks())) return false;
  return blocks() >= kMoreInDoubt * precise_blocks_ || !is_in_doubt(misfit_, judgement().pulls);
}

}  // namespace scattermeter
