#include "core/transport/white_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/transport/path_blocks.h"
#include "core/transport/sideways_growth.h"

namespace scattermeter {
namespace {

class TiltTally {
 public:
  TiltTally(const ScatteringView& view, const PathBoundary& boundary, const AbsorptionTilts& tilts)
      : view_(&view),
        boundary_(&boundary),
        tilts_(&tilts),
        sum(Eigen::MatrixXd::Zero(tilts.count(), view.n_rows)),
        per_eta(sum) {}

  void escape(const PathScore&) {}
  void camera(const PathScore& score) {
    const std::int32_t row = row_at(score.facet_idx, score.point_mm);
    if (row < 0) return;
    tilts_->add(score.weight, score.length_mm, sum.col(row).data());
    const double growth = score.per_eta + sideways(score, row);
    tilts_->add(score.weight * growth, score.length_mm, per_eta.col(row).data());
  }

 private:
  std::int32_t row_at(int facet_idx, const Eigen::Vector3d& point_mm) const {
    return row_of(*view_, boundary_->scene().mesh(), facet_idx, point_mm);
  }
  // Of its row's light. To find the rows beside takes longer than all else: some scores count for
  // all. Of faces alone: a row of many facets ends on others.
  double sideways(const PathScore& score, std::int32_t row) {
    constexpr int kOneOf = 4;
    if (boundary_->body().planes.empty() || ++scores_ % kOneOf != 0) return 0.0;
    const int plane = boundary_->body().plane_of_facet[static_cast<std::size_t>(score.facet_idx)];
    return kOneOf *
           sideways_growth(score.point_mm, score.moved_mm_per_eta, [&](const Eigen::Vector3d& x) {
             const int facet_idx = boundary_->facet_holding(plane, x);
             return facet_idx >= 0 && row_at(facet_idx, x) == row;
           });
  }

  const ScatteringView* view_;
  const PathBoundary* boundary_;
  int scores_ = 0;
  const AbsorptionTilts* tilts_;

 public:
  Eigen::MatrixXd sum, per_eta;
};

}  // namespace

int WhiteRows::levels_for(double paths) {
  int levels = 1;
  while (static_cast<double>(paths_of(levels)) < paths) ++levels;
  return levels;
}

std::int64_t WhiteRows::paths_of(int levels) {
  if (levels == 0) return 0;
  const double of_batch = static_cast<double>(kFirstPaths) / kBatches;
  return kBatches * std::llround(of_batch * std::exp2(0.25 * (levels - 1)));
}

WhiteRows::WhiteRows(const ScatteringView& view, double sigma_s_per_mm, double size_mm)
    : view_(view),
      sigma_s_per_mm_(sigma_s_per_mm),
      tilts_(sigma_s_per_mm, size_mm),
      sums_{0, Eigen::MatrixXd::Zero(tilts_.count(), view.n_rows),
            Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(kept_tilts()), view.n_rows),
            PackedBatches(kept_tilts(), kBatches, view.n_rows)} {}

bool WhiteRows::take(WhiteSums sums) {
  const auto has_shape_of = [](const auto& a, const auto& b) {
    return a.rows() == b.rows() && a.cols() == b.cols();
  };
  const auto have_shapes_of = [&](const auto& a, const auto& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), has_shape_of);
  };
  const bool fits = sums.levels > levels() && has_shape_of(sums.sum, sums_.sum) &&
                    has_shape_of(sums.per_eta, sums_.per_eta) &&
                    have_shapes_of(sums.batches.steps, sums_.batches.steps) &&
                    have_shapes_of(sums.batches.step_of, sums_.batches.step_of);
  if (fits) sums_ = std::move(sums);
  return fits;
}

void WhiteRows::refine(const PathWorld& world, std::uint64_t seed) {
  PathWorld white = world;
  white.medium = scattering_medium({sigma_s_per_mm_, 0.0, world.medium.eta_int_over_ext},
                                   world.medium.phase, world.medium.surface_alpha);
  PathOptions options;
  options.seed = seed;
  options.isotropic_beyond = kIsotropicBeyond;
  options.paths_per_block = static_cast<int>((paths_of(levels() + 1) - paths()) / kBatches);
  const int first = levels() * kBatches;
  int batch = 0;
  std::vector<Eigen::MatrixXf> further(kept_tilts(), Eigen::MatrixXf::Zero(kBatches, view_.n_rows));
  trace_blocks<TiltTally>(
      white, options, first, first + kBatches,
      [&] { return TiltTally(view_, white.boundary, tilts_); },
      [&](const TiltTally& block, const PathAudit&) {
        // A block estimates the whole from its own paths.
        sums_.sum += options.paths_per_block * block.sum;
        sums_.per_eta +=
            (options.paths_per_block * block.per_eta(kept(), Eigen::all)).cast<float>();
        for (std::size_t j = 0; j < further.size(); ++j) {
          further[j].row(batch) =
              (options.paths_per_block * block.sum.row(static_cast<Eigen::Index>(j) * kBatchStep))
                  .cast<float>();
        }
        ++batch;
      });
  sums_.batches.add(further);
  ++sums_.levels;
}

WhiteRows::Light WhiteRows::light(double sigma_a_per_mm) const {
  const AbsorptionTilts::Combination c = tilts_.at(sigma_a_per_mm);
  const Eigen::VectorXd per_area = (static_cast<double>(paths()) * view_.area_mm2).cwiseInverse();
  return {(sums_.sum.transpose() * c.l).cwiseProduct(per_area),
          (sums_.sum.transpose() * c.per_sigma_a).cwiseProduct(per_area)};
}

Eigen::VectorXd WhiteRows::per_eta(double sigma_a_per_mm) const {
  const Eigen::VectorXf l = tilts_.at(sigma_a_per_mm, kBatchStep).l(kept()).cast<float>();
  const Eigen::VectorXd area = static_cast<double>(paths()) * view_.area_mm2;
  return (sums_.per_eta.transpose() * l).cast<double>().cwiseQuotient(area);
}

WhiteRows::Departures WhiteRows::departures(double sigma_a_per_mm) const {
  constexpr Eigen::Index kHalf = kBatches / 2;
  const AbsorptionTilts::Combination c = tilts_.at(sigma_a_per_mm, kBatchStep);
  const Eigen::MatrixXf per_batch = sums_.batches.combined(c.per_sigma_a(kept()));
  const Eigen::RowVectorXf per_sigma_a =
      per_batch.bottomRows(kHalf).colwise().sum() - per_batch.topRows(kHalf).colwise().sum();
  const Eigen::VectorXd per_area = (static_cast<double>(paths()) * view_.area_mm2).cwiseInverse();
  Departures out{sums_.batches.combined(c.l(kept())).cast<double>(), {}};
  auto first = out.of_batch.topRows(kHalf), second = out.of_batch.bottomRows(kHalf);
  const Eigen::RowVectorXd first_mean = first.colwise().mean(),
                           second_mean = second.colwise().mean();
  first.rowwise() -= first_mean;
  second.rowwise() -= second_mean;
  out.second_half = {(kHalf * (second_mean - first_mean)).transpose().cwiseProduct(per_area),
                     per_sigma_a.cast<double>().transpose().cwiseProduct(per_area)};
  out.of_batch *= std::sqrt(kBatches / (kBatches - 2.0)) * per_area.asDiagonal();
  return out;
}

}  // namespace scattermeter
