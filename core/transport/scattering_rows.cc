#include "core/transport/scattering_rows.h"

#include <stdexcept>

#include "core/transport/path_blocks.h"

namespace scattermeter {
namespace {

// Scores of one block on the rows.
class RowTally {
 public:
  RowTally(const ScatteringView& view, const TriangleMesh& mesh)
      : view_(&view),
        mesh_(&mesh),
        weight(Eigen::VectorXd::Zero(view.n_rows)),
        weight_n(weight),
        weight_length(weight) {}

  void escape(const PathScore&) {}
  void camera(const PathScore& score) {
    const std::int32_t row = row_of(*view_, *mesh_, score.facet_idx, score.point_mm);
    if (row < 0) return;
    weight[row] += score.weight;
    weight_n[row] += score.weight * score.scatterings;
    weight_length[row] += score.weight * score.length_mm;
  }

 private:
  const ScatteringView* view_;
  const TriangleMesh* mesh_;

 public:
  Eigen::VectorXd weight, weight_n, weight_length;
};

}  // namespace

ScatteringSum::ScatteringSum(const ScatteringView& view, const Eigen::MatrixXd& projection)
    : view_(view),
      // Of sums over patches.
      projection_(projection * view.area_mm2.cwiseInverse().asDiagonal()),
      weight_(Eigen::VectorXd::Zero(view.n_rows)),
      weight_n_(weight_),
      weight_length_(weight_),
      square_(weight_),
      projected_(Eigen::VectorXd::Zero(projection.rows())),
      projected_square_(Eigen::MatrixXd::Zero(projection.rows(), projection.rows())) {
  if (projection.cols() != view.n_rows) {
    throw std::invalid_argument("ScatteringSum: projection and view differ in rows");
  }
}

void ScatteringSum::trace(const PathWorld& world, const PathOptions& options, int n) {
  if (blocks_ > 0 && world.medium.sigma_s_per_mm != sigma_s_) {
    throw std::invalid_argument("ScatteringSum: blocks of another medium");
  }
  sigma_s_ = world.medium.sigma_s_per_mm;
  trace_blocks<RowTally>(
      world, options, blocks_, blocks_ + n,
      [&] { return RowTally(view_, world.boundary.scene().mesh()); },
      [&](const RowTally& block, const PathAudit& audit) {
        weight_ += block.weight;
        weight_n_ += block.weight_n;
        weight_length_ += block.weight_length;
        square_ += block.weight.cwiseAbs2();
        const Eigen::VectorXd p = projection_ * block.weight;
        projected_ += p;
        projected_square_ += p * p.transpose();
        audit_ += audit;
      });
  blocks_ += n;
}

ScatteringImage ScatteringSum::image() const {
  const double n = blocks_;
  const Eigen::ArrayXd per_area = (n * view_.area_mm2.array()).inverse();
  ScatteringImage image;
  image.l = weight_.array() * per_area;
  image.per_log_sigma_s = (weight_n_.array() - sigma_s_ * weight_length_.array()) * per_area;
  image.per_sigma_a = -weight_length_.array() * per_area;
  image.variance =
      (square_.array() - weight_.array().square() / n) * per_area.square() * n / (n - 1.0);
  return image;
}

Eigen::MatrixXd ScatteringSum::projected_covariance() const {
  const double n = blocks_;
  return (projected_square_ - projected_ * projected_.transpose() / n) / (n * (n - 1.0));
}

}  // namespace scattermeter
