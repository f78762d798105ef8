#include "core/image_information.h"

#include <algorithm>
#include <numeric>

namespace scattermeter {
namespace {

ImageInformation of_rows(const DenseSystem& system, Eigen::Index begin, Eigen::Index end) {
  const Eigen::Index n_knots = system.weights.cols();
  const Eigen::Index n = n_knots + system.nuisance_columns.cols();
  ImageInformation out;
  out.information = Eigen::MatrixXd::Zero(n, n);
  out.right = Eigen::VectorXd::Zero(n);
  out.rows = static_cast<std::size_t>(end - begin);
  // In blocks: no second copy of the whole system.
  constexpr Eigen::Index kBlock = 512;
  for (Eigen::Index at = begin; at < end; at += kBlock) {
    const Eigen::Index m = std::min(kBlock, end - at);
    const Eigen::VectorXd inverse_std = system.std_l.segment(at, m).cwiseInverse();
    Eigen::MatrixXd a(m, n);
    a.leftCols(n_knots) = inverse_std.asDiagonal() * system.weights.middleRows(at, m);
    if (n > n_knots) {
      a.rightCols(n - n_knots) =
          inverse_std.asDiagonal() * system.nuisance_columns.middleRows(at, m);
    }
    const Eigen::VectorXd l = inverse_std.cwiseProduct(system.l.segment(at, m));
    out.information.selfadjointView<Eigen::Lower>().rankUpdate(a.transpose());
    out.right.noalias() += a.transpose() * l;
    out.l2 += l.squaredNorm();
  }
  out.information = Eigen::MatrixXd(out.information.selfadjointView<Eigen::Lower>());
  return out;
}

}  // namespace

ImageInformation& ImageInformation::operator+=(const ImageInformation& other) {
  information += other.information;
  right += other.right;
  l2 += other.l2;
  rows += other.rows;
  return *this;
}

ImageInformation image_information(const DenseSystem& system) {
  return of_rows(system, 0, system.weights.rows());
}

std::vector<ImageInformation> information_by_shot(const DenseSystem& system) {
  std::vector<ImageInformation> out;
  Eigen::Index begin = 0;
  for (const Eigen::Index n : system.shot_rows) {
    out.push_back(of_rows(system, begin, begin + n));
    begin += n;
  }
  return out;
}

ImageInformation with_nuisances(const ImageInformation& all, Eigen::Index n_knots,
                                const std::vector<Eigen::Index>& nuisances) {
  std::vector<Eigen::Index> columns(static_cast<std::size_t>(n_knots));
  std::iota(columns.begin(), columns.end(), Eigen::Index{0});
  for (const Eigen::Index v : nuisances) columns.push_back(n_knots + v);
  ImageInformation out = all;
  out.information = all.information(columns, columns);
  out.right = all.right(columns);
  return out;
}

}  // namespace scattermeter
