#include "core/view/row_interpolation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <oneapi/tbb/parallel_for.h>

#include "core/base/tangents.h"

namespace scattermeter {
namespace {

using Adjacent = std::vector<std::vector<std::int32_t>>;

// Whether each row is one of those of which no two are adjacent and to which no other can be added.
std::vector<bool> apart_from_each_other(const Adjacent& adjacent) {
  std::vector<bool> chosen(adjacent.size(), false);
  for (std::size_t j = 0; j < adjacent.size(); ++j) {
    chosen[j] = std::none_of(adjacent[j].begin(), adjacent[j].end(),
                             [&](std::int32_t k) { return chosen[static_cast<std::size_t>(k)]; });
  }
  return chosen;
}

// The rows up to so many steps away, itself included, ascending.
std::vector<std::int32_t> rows_about(std::int32_t row, int steps, const Adjacent& adjacent) {
  std::vector<std::int32_t> out = {row};
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0, n = out.size(); i < n; ++i) {
      const auto& next = adjacent[static_cast<std::size_t>(out[i])];
      out.insert(out.end(), next.begin(), next.end());
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
  }
  return out;
}

// The weights of values at these offsets, one a column: less with the distance.
Eigen::VectorXd nearness(const Eigen::Matrix2Xd& offsets_mm) {
  const double reach = 1.1 * offsets_mm.colwise().norm().maxCoeff();
  return (1.0 - offsets_mm.colwise().squaredNorm().array() / (reach * reach)).square().matrix();
}

// The shares of values at these offsets in the value at 0 of a plane through them. Absent where
// they nearly lie on a line or far to one side.
std::optional<Eigen::VectorXd> shares_of_plane(const Eigen::Matrix2Xd& offsets_mm) {
  constexpr double kLargestShare = 3.0;
  if (offsets_mm.cols() < 3) return std::nullopt;
  Eigen::Matrix3Xd a(3, offsets_mm.cols());
  a << Eigen::RowVectorXd::Ones(offsets_mm.cols()), offsets_mm / offsets_mm.cwiseAbs().maxCoeff();
  const Eigen::Matrix3Xd weighted = a * nearness(offsets_mm).asDiagonal();
  const Eigen::LDLT<Eigen::Matrix3d> gram(weighted * a.transpose());
  // The pivots: of points on a line one is 0, and rcond() would not tell.
  if (!(gram.vectorD().minCoeff() > 1e-4 * gram.vectorD().maxCoeff())) return std::nullopt;
  Eigen::VectorXd shares = weighted.transpose() * gram.solve(Eigen::Vector3d::UnitX());
  if (!(shares.cwiseAbs().maxCoeff() < kLargestShare)) return std::nullopt;
  return shares;
}

// The chosen rows about a row that is not, and their shares in its value. offset_mm(k): of row k
// from it.
template <class Offset>
std::vector<std::pair<std::int32_t, double>> shares_about(std::int32_t row,
                                                          const Adjacent& adjacent,
                                                          const std::vector<bool>& chosen,
                                                          const Offset& offset_mm) {
  const auto with = [](const std::vector<std::int32_t>& from, const Eigen::VectorXd& shares) {
    std::vector<std::pair<std::int32_t, double>> out;
    for (std::size_t i = 0; i < from.size(); ++i) {
      out.emplace_back(from[i], shares[static_cast<Eigen::Index>(i)]);
    }
    return out;
  };
  const auto about = [&](int steps) {
    std::vector<std::int32_t> from = rows_about(row, steps, adjacent);
    std::erase_if(from, [&](std::int32_t k) { return !chosen[static_cast<std::size_t>(k)]; });
    Eigen::Matrix2Xd offsets_mm(2, static_cast<Eigen::Index>(from.size()));
    for (std::size_t i = 0; i < from.size(); ++i) {
      offsets_mm.col(static_cast<Eigen::Index>(i)) = offset_mm(from[i]);
    }
    return std::pair(from, offsets_mm);
  };
  constexpr int kMostSteps = 4;
  for (int steps = 2; steps <= kMostSteps; ++steps) {
    const auto& [from, offsets_mm] = about(steps);
    if (const auto shares = shares_of_plane(offsets_mm)) return with(from, *shares);
  }
  const auto& [from, offsets_mm] = about(1);
  const Eigen::VectorXd near = nearness(offsets_mm);
  return with(from, near / near.sum());
}

}  // namespace

RowInterpolation interpolation_of_rows(const std::vector<Eigen::Vector3d>& centers_mm,
                                       const std::vector<Eigen::Vector3d>& normals,
                                       const Adjacent& adjacent) {
  const std::size_t n = centers_mm.size();
  if (normals.size() != n || (!adjacent.empty() && adjacent.size() != n)) {
    throw std::invalid_argument("interpolation_of_rows: sizes differ");
  }
  RowInterpolation out;
  const auto rows = static_cast<Eigen::Index>(n);
  if (adjacent.empty()) {
    out.rows.resize(n);
    std::iota(out.rows.begin(), out.rows.end(), std::size_t{0});
    out.from_rows.resize(rows, rows);
    out.from_rows.setIdentity();
    return out;
  }
  const std::vector<bool> chosen = apart_from_each_other(adjacent);
  std::vector<std::int32_t> column(n, -1);
  for (std::size_t j = 0; j < n; ++j) {
    if (!chosen[j]) continue;
    column[j] = static_cast<std::int32_t>(out.rows.size());
    out.rows.push_back(j);
  }
  std::vector<std::vector<Eigen::Triplet<double>>> of_row(n);
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t j) {
    const auto row = static_cast<std::int32_t>(j);
    if (chosen[j]) {
      of_row[j] = {{row, column[j], 1.0}};
      return;
    }
    const auto along = tangents(normals[j]);
    for (const auto& [k, share] : shares_about(row, adjacent, chosen, [&](std::int32_t other) {
           const Eigen::Vector3d step = centers_mm[static_cast<std::size_t>(other)] - centers_mm[j];
           return Eigen::Vector2d(along[0].dot(step), along[1].dot(step));
         })) {
      of_row[j].emplace_back(row, column[static_cast<std::size_t>(k)], share);
    }
  });
  std::vector<Eigen::Triplet<double>> all;
  for (const auto& some : of_row) all.insert(all.end(), some.begin(), some.end());
  out.from_rows.resize(rows, static_cast<Eigen::Index>(out.rows.size()));
  out.from_rows.setFromTriplets(all.begin(), all.end());
  return out;
}

}  // namespace scattermeter
