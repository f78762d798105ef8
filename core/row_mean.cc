#include "core/row_mean.h"

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
  monomials_ += from_origin * from_origin.transpose();
  value_ += value * from_origin;
  variance_ += variance;
}

RowFit::RowFit(const RowSum& row)
    : row_(row), gram_(row.monomials_), moment_(row.value_), equations_(row.n()) {}

void RowFit::add_neighbour(const RowSum& neighbour, const Eigen::Vector2i& shift_px) {
  constexpr double kNeighbour = 0.3;
  const Monomials place = moved(neighbour.mean_place(), shift_px);
  gram_ += kNeighbour * neighbour.n() * place * place.transpose();
  moment_ += kNeighbour * neighbour.value_[0] * place;
  equations_ += 1.0;
}

RowMean RowFit::mean_over(const Monomials& target) const {
  // Half as many equations again as terms, not all nearly on a line, and no more than half as much
  // noise again.
  constexpr double kEquationsPerTerm = 1.5;
  constexpr double kMostSpread = 1.5;
  const RowMean plain{row_.mean(), row_.variance_of_mean(), 1.0};
  const Monomials step = target - row_.mean_place();
  for (const Eigen::Index terms : {Eigen::Index{6}, Eigen::Index{3}}) {
    if (equations_ < kEquationsPerTerm * static_cast<double>(terms)) continue;
    const Eigen::LDLT<Eigen::MatrixXd> gram(gram_.topLeftCorner(terms, terms));
    if (!(gram.rcond() > 1e-10)) continue;
    const Eigen::VectorXd weight = gram.solve(step.head(terms));
    // The plain mean and the slopes of a least-squares fit do not share noise; neighbours only
    // lower it.
    const double spread = 1.0 + row_.n() * weight.dot(step.head(terms));
    if (!(spread < kMostSpread)) continue;
    return {plain.value + weight.dot(moment_.head(terms)), plain.variance * spread, spread};
  }
  return plain;
}

}  // namespace scattermeter
