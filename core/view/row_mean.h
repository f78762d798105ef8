// The mean of one channel over a patch, corrected for the positions of the channel's samples.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace scattermeter {

// Monomials up to degree 3 of a position in the frame, in units of 16 px, or their mean over
// positions: 1, x, y, x^2, x y, y^2, x^3, x^2 y, x y^2, y^3.
using Monomials = Eigen::Matrix<double, 10, 1>;
Monomials monomials_at(const Eigen::Vector2i& px);
// Mean monomials over the same positions, relative to another origin: every position shifts by
// `by_px`.
Monomials moved(const Monomials& mean, const Eigen::Vector2i& by_px);

// Running sums over the samples of one channel in one row.
class RowSum {
 public:
  // from_origin: position of the sample relative to the row's origin. value: the quantity to be
  // averaged; variance: of the value, > 0.
  void add(const Monomials& from_origin, double value, double variance);

  double n() const { return moments_[0]; }
  double mean() const { return value_[0] / n(); }
  double variance_of_mean() const { return variance_ / (n() * n()); }
  Monomials mean_monomials() const { return moments_.head<10>() / n(); }

 private:
  friend class RowFit;
  // Sums over all positions up to degree 6: the ten monomials, x^4, x^3 y, x^2 y^2, x y^3, y^4, and
  // so on.
  using Moments = Eigen::Matrix<double, 28, 1>;
  Moments moments_ = Moments::Zero();
  Monomials value_ = Monomials::Zero();  // monomials times the value
  double variance_ = 0;
};

struct RowMean {
  double value = 0;
  double variance = 0;
  double spread = 1;  // ratio of the variance to that of the plain mean
};

// The variation of the channel's values across a row and its neighbours: a least-squares cubic, or
// a quadratic or a plane where samples are few. Where light decays within a few samples, terms that
// are missing bias whole lines of rows along an edge. Measured on noise-free shots, patches of 8 px
// and a mean free path of 5.6 px: a quadratic with neighbours as their means, a plane where samples
// were few, was wrong by up to 2.6 %; the squares of its errors, in deviations of the rows, added
// up to 41 (red, one shot), those of the cubic to 5.
class RowFit {
 public:
  // Precondition: row.n() > 0.
  explicit RowFit(const RowSum& row);
  // Whether the row's own samples suffice, so that neighbours would only add work.
  bool suffices() const { return row_.n() >= 40.0; }
  // Adds the samples of a neighbour. shift_px: its origin relative to the row's.
  void add_neighbour(const RowSum& neighbour, const Eigen::Vector2i& shift_px);

  // Mean over positions whose mean monomials, relative to the row's origin, are given: the plain
  // mean of the row's own samples plus the difference that the fit predicts.
  RowMean mean_over(const Monomials& target) const;

 private:
  // Uses the first `kTerms` monomials; false if they cannot be separated or would amplify the noise
  // too much.
  template <int kTerms>
  bool fitted_mean(const Monomials& step, RowMean& mean) const;

  const RowSum& row_;
  RowSum::Moments moments_;  // of all samples, from the row's origin
  Monomials moment_;         // sum of their monomials times their values
};

}  // namespace scattermeter
