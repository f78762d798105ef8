#include "core/fit/image_information.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace scattermeter {

ImageInformation image_information(const DenseSystem& system) {
  const Eigen::Index n_knots = system.weights.cols();
  const Eigen::Index n = n_knots + system.nuisance_columns.cols();
  const Eigen::Index rows = system.l.size();
  ImageInformation out;
  out.information = Eigen::MatrixXd::Zero(n, n);
  out.right = Eigen::VectorXd::Zero(n);
  out.rows = static_cast<std::size_t>(rows);
  // In blocks: no second copy of the whole system.
  constexpr Eigen::Index kBlock = 512;
  Eigen::MatrixXd a(std::min(kBlock, rows), n);
  for (Eigen::Index at = 0; at < rows; at += kBlock) {
    const Eigen::Index m = std::min(kBlock, rows - at);
    const auto std_l = system.std_l.segment(at, m);
    const Eigen::VectorXd inverse_std = std_l.cwiseInverse();
    if (a.rows() != m) a.resize(m, n);
    a.leftCols(n_knots) = inverse_std.asDiagonal() * system.weights.middleRows(at, m);
    if (n > n_knots) {
      a.rightCols(n - n_knots) =
          inverse_std.asDiagonal() * system.nuisance_columns.middleRows(at, m);
    }
    const Eigen::VectorXd l = inverse_std.cwiseProduct(system.l.segment(at, m));
    out.is_sound = out.is_sound && std_l.minCoeff() > 0.0 && std_l.allFinite() && l.allFinite() &&
                   a.allFinite();
    out.information.selfadjointView<Eigen::Lower>().rankUpdate(a.transpose());
    out.right.noalias() += a.transpose() * l;
    out.l2 += l.squaredNorm();
  }
  out.information = Eigen::MatrixXd(out.information.selfadjointView<Eigen::Lower>());
  return out;
}

std::vector<ShotInformation> information_by_shot(const ImageRows& image) {
  std::vector<ShotInformation> out(image.shots());
  for_each_shot(image, [&](std::size_t s, const ShotSystem& shot) {
    out[s] = {image_information(*shot.system), shot.nuisances};
  });
  return out;
}

ImageInformation joint_information(const std::vector<ShotInformation>& shots,
                                   std::size_t n_nuisances) {
  if (shots.empty()) throw std::invalid_argument("joint_information: no shots");
  const Eigen::Index n_knots =
      shots.front().image.right.size() - static_cast<Eigen::Index>(shots.front().nuisances.size());
  const Eigen::Index n = n_knots + static_cast<Eigen::Index>(n_nuisances);
  ImageInformation out;
  out.information = Eigen::MatrixXd::Zero(n, n);
  out.right = Eigen::VectorXd::Zero(n);
  for (const ShotInformation& shot : shots) {
    std::vector<Eigen::Index> indices(static_cast<std::size_t>(n_knots));
    std::iota(indices.begin(), indices.end(), Eigen::Index{0});
    for (const Eigen::Index v : shot.nuisances) indices.push_back(n_knots + v);
    out.information(indices, indices) += shot.image.information;
    out.right(indices) += shot.image.right;
    out.l2 += shot.image.l2;
    out.rows += shot.image.rows;
    out.is_sound = out.is_sound && shot.image.is_sound;
  }
  return out;
}

}  // namespace scattermeter
