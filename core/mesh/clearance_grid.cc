#include "core/mesh/clearance_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

namespace scattermeter {
namespace {

constexpr double kStepsPerCell = 4.0;

// min over j of value[j] + (i - j)^2 for every i of a row.
void transform_row(std::vector<float>& row, std::vector<float>& work) {
  const int n = static_cast<int>(row.size());
  for (int i = 0; i < n; ++i) {
    float best = row[static_cast<std::size_t>(i)];
    for (int step = 1; step < n; ++step) {
      const auto squared = static_cast<float>(step * step);
      if (squared >= best) break;
      if (i >= step) best = std::min(best, squared + row[static_cast<std::size_t>(i - step)]);
      if (i + step < n) best = std::min(best, squared + row[static_cast<std::size_t>(i + step)]);
    }
    work[static_cast<std::size_t>(i)] = best;
  }
  row = work;
}

}  // namespace

ClearanceGrid::ClearanceGrid(const TriangleMesh& mesh, int cells) {
  if (cells < 1) {
    throw std::invalid_argument("ClearanceGrid: cells = " + std::to_string(cells));
  }
  const Box3d box = bounds(mesh);
  cell_mm_ = box.size_mm().maxCoeff() / cells;
  cells_per_mm_ = 1.0 / cell_mm_;
  origin_mm_ = box.min_mm - Eigen::Vector3d::Constant(cell_mm_);
  n_ = (box.size_mm() * cells_per_mm_).array().ceil().cast<int>() + 2;
  constexpr float kFar = std::numeric_limits<float>::infinity();
  std::vector<float> squared(index(n_[0] - 1, n_[1] - 1, n_[2] - 1) + 1, kFar);
  for (int f = 0; f < static_cast<int>(mesh.triangles.size()); ++f) mark(mesh, f, squared);
  // Squared distances in cells, axis by axis.
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3;
    const int c = (axis + 2) % 3;
    std::vector<float> row(static_cast<std::size_t>(n_[axis]));
    std::vector<float> work(row.size());
    Eigen::Vector3i at;
    for (at[b] = 0; at[b] < n_[b]; ++at[b]) {
      for (at[c] = 0; at[c] < n_[c]; ++at[c]) {
        for (at[axis] = 0; at[axis] < n_[axis]; ++at[axis]) {
          row[static_cast<std::size_t>(at[axis])] = squared[index(at[0], at[1], at[2])];
        }
        transform_row(row, work);
        for (at[axis] = 0; at[axis] < n_[axis]; ++at[axis]) {
          squared[index(at[0], at[1], at[2])] = row[static_cast<std::size_t>(at[axis])];
        }
      }
    }
  }
  step_mm_ = cell_mm_ / kStepsPerCell;
  steps_.reserve(squared.size());
  for (const float s : squared) {
    const double steps = kStepsPerCell * std::sqrt(static_cast<double>(s)) * 0.999999;
    steps_.push_back(static_cast<std::uint8_t>(std::min(steps, 255.0)));
  }
}

// Zero for the cells that the facet may touch and for their 26 neighbours: the distance between the
// borders of two cells is that between their centres, one cell less along each axis.
void ClearanceGrid::mark(const TriangleMesh& mesh, int facet, std::vector<float>& squared) const {
  const auto& t = mesh.triangles[static_cast<std::size_t>(facet)];
  std::array<Eigen::Vector3d, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = (mesh.vertices_mm[static_cast<std::size_t>(t[i])] - origin_mm_) * cells_per_mm_;
  }
  const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
  const double offset = normal.dot(p[0]);
  constexpr double kRound = 1e-6;
  const double reach = 0.5 * normal.cwiseAbs().sum() + kRound;
  const Eigen::Vector3d low = p[0].cwiseMin(p[1]).cwiseMin(p[2]).array() - kRound;
  const Eigen::Vector3d high = p[0].cwiseMax(p[1]).cwiseMax(p[2]).array() + kRound;
  const Eigen::Vector3i from = low.array().floor().cast<int>();
  const Eigen::Vector3i to = high.array().floor().cast<int>();
  for (int k = from[2]; k <= to[2]; ++k) {
    for (int j = from[1]; j <= to[1]; ++j) {
      for (int i = from[0]; i <= to[0]; ++i) {
        if (std::abs(normal.dot(Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5)) - offset) > reach) {
          continue;
        }
        for (int c = std::max(0, k - 1); c <= std::min(n_[2] - 1, k + 1); ++c) {
          for (int b = std::max(0, j - 1); b <= std::min(n_[1] - 1, j + 1); ++b) {
            for (int a = std::max(0, i - 1); a <= std::min(n_[0] - 1, i + 1); ++a) {
              squared[index(a, b, c)] = 0.0F;
            }
          }
        }
      }
    }
  }
}

}  // namespace scattermeter
