#include "core/transport/white_rows.h"

#include <algorithm>
#include <cmath>

#include "core/transport/path_blocks.h"

namespace scattermeter {
namespace {

class TiltTally {
 public:
  TiltTally(const ScatteringView& view, const TriangleMesh& mesh, const AbsorptionTilts& tilts)
      : view_(&view),
        mesh_(&mesh),
        tilts_(&tilts),
        sum(Eigen::MatrixXd::Zero(tilts.count(), view.n_rows)) {}

  void escape(const PathScore&) {}
  void camera(const PathScore& score) {
    const std::int32_t row = row_of(*view_, *mesh_, score);
    if (row >= 0) tilts_->add(score.weight, score.length_mm, sum.col(row).data());
  }

 private:
  const ScatteringView* view_;
  const TriangleMesh* mesh_;
  const AbsorptionTilts* tilts_;

 public:
  Eigen::MatrixXd sum;
};

}  // namespace

int WhiteRows::levels_for(double paths) {
  int levels = 1;
  while (static_cast<double>(kFirstPaths) * std::exp2(levels - 1) < paths) ++levels;
  return levels;
}

WhiteRows::WhiteRows(const ScatteringView& view, double sigma_s_per_mm, double size_mm)
    : view_(view),
      sigma_s_per_mm_(sigma_s_per_mm),
      tilts_(sigma_s_per_mm, size_mm),
      sum_(Eigen::MatrixXd::Zero(tilts_.count(), view.n_rows)) {}

void WhiteRows::refine(const PathWorld& world, std::uint64_t seed) {
  if (batch_.empty()) {
    const Eigen::Index kept = (tilts_.count() - 1) / kBatchStep + 1;
    batch_.assign(static_cast<std::size_t>(kept), Eigen::MatrixXf::Zero(kBatches, view_.n_rows));
  }
  PathWorld white = world;
  white.medium.sigma_s_per_mm = sigma_s_per_mm_;
  white.medium.sigma_a_per_mm = 0.0;
  PathOptions options;
  options.seed = seed;
  const std::int64_t more = levels_ == 0 ? kFirstPaths : paths();
  options.paths_per_block = static_cast<int>(more / kBatches);
  const int first = levels_ * kBatches;
  int batch = 0;
  trace_blocks<TiltTally>(
      white, options, first, first + kBatches,
      [&] { return TiltTally(view_, white.boundary.scene().mesh(), tilts_); },
      [&](const TiltTally& block, const PathAudit&) {
        // A block estimates the whole from its own paths.
        sum_ += options.paths_per_block * block.sum;
        for (std::size_t j = 0; j < batch_.size(); ++j) {
          batch_[j].row(batch) +=
              (options.paths_per_block * block.sum.row(static_cast<Eigen::Index>(j) * kBatchStep))
                  .cast<float>();
        }
        ++batch;
      });
  ++levels_;
}

WhiteRows::Light WhiteRows::light(double sigma_a_per_mm) const {
  const AbsorptionTilts::Combination c = tilts_.at(sigma_a_per_mm);
  const Eigen::VectorXd per_area = (static_cast<double>(paths()) * view_.area_mm2).cwiseInverse();
  return {(sum_.transpose() * c.l).cwiseProduct(per_area),
          (sum_.transpose() * c.per_sigma_a).cwiseProduct(per_area)};
}

Eigen::MatrixXd WhiteRows::departures(double sigma_a_per_mm) const {
  const AbsorptionTilts::Combination c = tilts_.at(sigma_a_per_mm, kBatchStep);
  Eigen::MatrixXf sums = Eigen::MatrixXf::Zero(kBatches, view_.n_rows);
  for (std::size_t j = 0; j < batch_.size(); ++j) {
    sums += static_cast<float>(c.l[static_cast<Eigen::Index>(j) * kBatchStep]) * batch_[j];
  }
  const double own_paths = static_cast<double>(paths()) / kBatches;
  const Eigen::VectorXd size =
      (std::sqrt(kBatches * (kBatches - 1.0)) * own_paths * view_.area_mm2).cwiseInverse();
  Eigen::MatrixXd out = sums.cast<double>();
  out.rowwise() -= Eigen::RowVectorXd(out.colwise().mean());
  return out * size.asDiagonal();
}

}  // namespace scattermeter
