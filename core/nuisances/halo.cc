#include "core/nuisances/halo.h"

#include <cmath>
#include <numbers>

namespace scattermeter {
namespace {

constexpr int kCells = 16;  // along the longer side of the object
constexpr int kMargin = 2;  // of cells, about it

// The object's light, by cell, and the halo that it makes.
class HaloGrid {
 public:
  HaloGrid(const Eigen::Array2d& from_px, const Eigen::Array2d& size_px)
      : from_px_(from_px),
        cells_((size_px / size_px.maxCoeff() * kCells).ceil().cast<int>()),
        cell_px_(size_px / cells_.cast<double>()),
        std_px_(0.25 * size_px.x()),
        sum_(Eigen::ArrayXXd::Zero(cells_.x(), cells_.y())),
        rows_(sum_),
        halo_(cells_.x() + 2 * kMargin, cells_.y() + 2 * kMargin) {}

  void add(const Eigen::Vector2d& at_px, double counts) {
    const Eigen::Array2i cell =
        ((at_px.array() - from_px_) / cell_px_).cast<int>().max(0).min(cells_ - 1);
    sum_(cell.x(), cell.y()) += counts;
    rows_(cell.x(), cell.y()) += 1.0;
  }

  void spread() {
    const Eigen::ArrayXXd light = (rows_ > 0.0).select(sum_ / rows_.max(1.0), 0.0);
    const Eigen::MatrixXd along = spread_along(0), across = spread_along(1);
    halo_ = (along * light.matrix() * across.transpose()).array();
  }

  double at(const Eigen::Vector2d& at_px) const {
    const Eigen::Array2d at = (at_px.array() - from_px_) / cell_px_ - 0.5 + kMargin;
    const Eigen::Array2i low =
        at.floor().cast<int>().max(0).min(Eigen::Array2i(halo_.rows() - 2, halo_.cols() - 2));
    const Eigen::Array2d t = (at - low.cast<double>()).max(0.0).min(1.0);
    const int x = low.x(), y = low.y();
    return std::lerp(std::lerp(halo_(x, y), halo_(x + 1, y), t.x()),
                     std::lerp(halo_(x, y + 1), halo_(x + 1, y + 1), t.x()), t.y());
  }

  // Of the cells about the object.
  double beside() const {
    const Eigen::Index m = kMargin - 1;
    const auto ring = halo_.block(m, m, cells_.x() + 2, cells_.y() + 2);
    const auto inside = halo_.block(kMargin, kMargin, cells_.x(), cells_.y());
    return (ring.sum() - inside.sum()) / static_cast<double>(ring.size() - inside.size());
  }

 private:
  // From the cells along an axis to those and the margins'.
  Eigen::MatrixXd spread_along(Eigen::Index axis) const {
    const double cell_std = std_px_ / cell_px_[axis];
    Eigen::MatrixXd out(cells_[axis] + 2 * kMargin, cells_[axis]);
    for (Eigen::Index i = 0; i < out.rows(); ++i) {
      for (Eigen::Index j = 0; j < out.cols(); ++j) {
        const double apart = static_cast<double>(i - kMargin - j) / cell_std;
        out(i, j) = std::exp(-0.5 * apart * apart) / (cell_std * std::sqrt(2.0 * std::numbers::pi));
      }
    }
    return out;
  }

  Eigen::Array2d from_px_;
  Eigen::Array2i cells_;
  Eigen::Array2d cell_px_;
  double std_px_;
  Eigen::ArrayXXd sum_, rows_;  // by cell
  Eigen::ArrayXXd halo_;
};

}  // namespace

Halo halo(const std::vector<Eigen::Vector2d>& at_px, const Eigen::VectorXd& counts) {
  Halo out{Eigen::VectorXd::Zero(counts.size())};
  if (at_px.empty()) return out;
  Eigen::Array2d low = at_px.front(), high = low;
  for (const Eigen::Vector2d& at : at_px) {
    low = low.min(at.array());
    high = high.max(at.array());
  }
  if (!((high - low) > 0.0).all()) return out;
  HaloGrid grid(low, high - low);
  for (Eigen::Index i = 0; i < counts.size(); ++i) {
    grid.add(at_px[static_cast<std::size_t>(i)], counts[i]);
  }
  grid.spread();
  for (Eigen::Index i = 0; i < counts.size(); ++i) {
    out.counts[i] = grid.at(at_px[static_cast<std::size_t>(i)]);
  }
  out.beside_counts = grid.beside();
  return out;
}

}  // namespace scattermeter
