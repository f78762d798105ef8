#include "core/view/row_mean.h"

#include <array>
#include <cstddef>

#include <Eigen/Cholesky>

namespace scattermeter {

namespace {

constexpr double kUnit = 1.0 / 16.0;  // powers stay near one

// Place of x^a y^b among monomials by degree.
constexpr int place(int a, int b) { return (a + b) * (a + b + 1) / 2 + b; }

// Sums of monomials up to a degree, by degree, after all positions have shifted by (x, y).
template <int kDegree, class Sums>
Sums shifted(const Sums& sums, double x, double y) {
  constexpr auto n = static_cast<std::size_t>(kDegree + 1);
  // of(k, i): binomial coefficient times the power k - i of the shift.
  using Table = std::array<std::array<double, n>, n>;
  const auto table = [](double by) {
    Table of{};
    of[0][0] = 1.0;
    for (std::size_t k = 1; k < n; ++k) {
      of[k][0] = by * of[k - 1][0];
      for (std::size_t i = 1; i <= k; ++i) of[k][i] = of[k - 1][i - 1] + by * of[k - 1][i];
    }
    return of;
  };
  const Table of_x = table(x), of_y = table(y);
  Sums middle = Sums::Zero(), out = Sums::Zero();
  for (int a = 0; a <= kDegree; ++a) {
    for (int b = 0; a + b <= kDegree; ++b) {
      for (int i = 0; i <= a; ++i) {
        middle[place(a, b)] +=
            of_x[static_cast<std::size_t>(a)][static_cast<std::size_t>(i)] * sums[place(i, b)];
      }
    }
  }
  for (int a = 0; a <= kDegree; ++a) {
    for (int b = 0; a + b <= kDegree; ++b) {
      for (int j = 0; j <= b; ++j) {
        out[place(a, b)] +=
            of_y[static_cast<std::size_t>(b)][static_cast<std::size_t>(j)] * middle[place(a, j)];
      }
    }
  }
  return out;
}

}  // namespace

Monomials monomials_at(const Eigen::Vector2i& px) {
  const double x = kUnit * px.x();
  const double y = kUnit * px.y();
  return (Monomials() << 1.0, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y)
      .finished();
}

Monomials moved(const Monomials& mean, const Eigen::Vector2i& by_px) {
  return shifted<3>(mean, kUnit * by_px.x(), kUnit * by_px.y());
}

void RowSum::add(const Monomials& from_origin, double value, double variance) {
  const auto cubes = from_origin.tail<4>();
  const double xxx = cubes[0], yyy = cubes[3];
  moments_.head<10>() += from_origin;
  const double x = from_origin[1], y = from_origin[2], xx = from_origin[3], xy = from_origin[4],
               yy = from_origin[5];
  moments_.segment<4>(10) += x * cubes;
  moments_[14] += y * yyy;
  moments_.segment<4>(15) += xx * cubes;
  moments_[19] += xy * yyy;
  moments_[20] += yy * yyy;
  moments_.segment<4>(21) += xxx * cubes;
  moments_.tail<3>() += yyy * cubes.tail<3>();
  value_ += value * from_origin;
  variance_ += variance;
}

RowFit::RowFit(const RowSum& row) : row_(row), moments_(row.moments_), moment_(row.value_) {}

void RowFit::add_neighbour(const RowSum& neighbour, const Eigen::Vector2i& shift_px) {
  const double x = kUnit * shift_px.x(), y = kUnit * shift_px.y();
  moments_ += shifted<6>(neighbour.moments_, x, y);
  moment_ += shifted<3>(neighbour.value_, x, y);
}

template <int kTerms>
bool RowFit::fitted_mean(const Monomials& step, RowMean& mean) const {
  // Half as many equations again as terms, not all nearly on a line, and no more than half as much
  // noise again.
  constexpr double kEquationsPerTerm = 1.5;
  constexpr double kMostSpread = 1.5;
  if (moments_[0] < kEquationsPerTerm * kTerms) return false;
  using Square = Eigen::Matrix<double, kTerms, kTerms>;
  using Vector = Eigen::Matrix<double, kTerms, 1>;
  Square products;  // the sum of the product of each two monomials
  for (int p = 0, i = 0; i < kTerms; ++p) {
    for (int b = 0; b <= p; ++b, ++i) {
      for (int q = 0, j = 0; j < kTerms; ++q) {
        for (int d = 0; d <= q; ++d, ++j) products(i, j) = moments_[place(p - b + q - d, b + d)];
      }
    }
  }
  const Eigen::LDLT<Square> gram(products);
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
  if (!fitted_mean<10>(step, mean) && !fitted_mean<6>(step, mean)) fitted_mean<3>(step, mean);
  return mean;
}

}  // namespace scattermeter
