#include "core/transport/packed_batches.h"

#include <cmath>

namespace scattermeter {
namespace {

constexpr float kMost = 127.0F;

}  // namespace

PackedBatches::PackedBatches(std::size_t tilts, Eigen::Index batches, Eigen::Index rows)
    : steps(tilts, Bytes::Zero(batches, rows)), step_of(tilts, Eigen::VectorXf::Zero(rows)) {}

void PackedBatches::add(const std::vector<Eigen::MatrixXf>& sums) {
  for (std::size_t t = 0; t < steps.size(); ++t) {
    for (Eigen::Index row = 0; row < step_of[t].size(); ++row) {
      Eigen::VectorXf d = step_of[t][row] * steps[t].col(row).cast<float>() + sums[t].col(row);
      if (t > 0) d -= sums[t - 1].col(row);
      d.array() -= d.mean();
      const float step = d.cwiseAbs().maxCoeff() / kMost;
      step_of[t][row] = step;
      if (!(step > 0.0F)) continue;
      steps[t].col(row) = (d / step).array().round().cast<std::int8_t>();
    }
  }
}

Eigen::MatrixXf PackedBatches::combined(const Eigen::VectorXd& weights) const {
  Eigen::MatrixXf out = Eigen::MatrixXf::Zero(steps.front().rows(), steps.front().cols());
  double later = 0.0;  // weights of this tilt and those after it, all of which contain its numbers
  for (std::size_t t = steps.size(); t-- > 0;) {
    later += weights[static_cast<Eigen::Index>(t)];
    for (Eigen::Index row = 0; row < out.cols(); ++row) {
      const float factor = static_cast<float>(later) * step_of[t][row];
      if (factor != 0.0F) out.col(row) += factor * steps[t].col(row).cast<float>();
    }
  }
  return out;
}

}  // namespace scattermeter
