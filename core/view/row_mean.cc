#include "core/view/row_mean.h"

#include <Eigen/Cholesky>

namespace scattermeter {

Monomials monomials_at(const Eigen::Vector2i& px) {
  constexpr double kUnit = 1.0 / 16.0;  // squares stay near one
  const double x = kUnit * px.x();
  const double y = kUnit * px.y();
  return (Monomials() << 1.0, x, y, x * x, x * y, y * y).finished();
}

Monomials moved(const Monomials& mean, const Eigen::Vector2i& by_px) {
  const Monomials by = monomials_at(by_px);
  Monomials out = mean;
  out[1] += by[1];
  out[2] += by[2];
  out[3] += 2.0 * by[1] * mean[1] + by[3];
  out[4] += by[1] * mean[2] + by[2] * mean[1] + by[4];
  out[5] += 2.0 * by[2] * mean[2] + by[5];
  return out;
}

void RowSum::add(const Monomials& from_origin, double value, double variance) {
  moments_.head<6>() += from_origin;
  const double x = from_origin[1], y = from_origin[2], xx = from_origin[3], xy = from_origin[4],
               yy = from_origin[5];
  moments_.tail<9>() += (Eigen::Matrix<double, 9, 1>() << x * xx, y * xx, x * yy, y * yy, xx * xx,
                         xx * xy, xx * yy, xy * yy, yy * yy)
                            .finished();
  value_ += value * from_origin;
  variance_ += variance;
}

RowFit::RowFit(const RowSum& row) : row_(row), moment_(row.value_), equations_(row.n()) {
  // Index of the moment that is the product of two monomials.
  constexpr int kProduct[6][6] = {{0, 1, 2, 3, 4, 5},    {1, 3, 4, 6, 7, 8},
                                  {2, 4, 5, 7, 8, 9},    {3, 6, 7, 10, 11, 12},
                                  {4, 7, 8, 11, 12, 13}, {5, 8, 9, 12, 13, 14}};
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) gram_(i, j) = row.moments_[kProduct[i][j]];
  }
}

void RowFit::add_neighbour(const RowSum& neighbour, const Eigen::Vector2i& shift_px) {
  constexpr double kNeighbour = 0.3;
  const Monomials monomials = moved(neighbour.mean_monomials(), shift_px);
  gram_ += kNeighbour * neighbour.n() * monomials * monomials.transpose();
  moment_ += kNeighbour * neighbour.value_[0] * monomials;
  equations_ += 1.0;
}

template <int kTerms>
bool RowFit::fitted_mean(const Monomials& step, RowMean& mean) const {
  // Half as many equations again as terms, not all nearly on a line, and no more than half as much
  // noise again.
  constexpr double kEquationsPerTerm = 1.5;
  constexpr double kMostSpread = 1.5;
  if (equations_ < kEquationsPerTerm * kTerms) return false;
  using Square = Eigen::Matrix<double, kTerms, kTerms>;
  using Vector = Eigen::Matrix<double, kTerms, 1>;
  const Eigen::LDLT<Square> gram(gram_.topLeftCorner<kTerms, kTerms>());
  if (!(gram.rcond() > 1e-10)) return false;
  const Vector weight = gram.solve(Vector(step.head<kTerms>()));
  // The plain mean and the slopes of a least-squares fit do not share noise; neighbours only
  // lower it.
  const double spread = 1.0 + row_.n() * weight.dot(step.head<kTerms>());
  if (!(spread < kMostSpread)) return false;
  mean = {mean.value + weight.dot(moment_.head<kTerms>()), mean.variance * spread, spread};
  return true;
}

RowMean RowFit::mean_over(const Monomials& target) const {
  RowMean mean{row_.mean(), row_.variance_of_mean(), 1.0};
  const Monomials step = target - row_.mean_monomials();
  if (!fitted_mean<6>(step, mean)) fitted_mean<3>(step, mean);
  return mean;
}

}  // namespace scattermeter
