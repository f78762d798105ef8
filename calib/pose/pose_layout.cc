#include "calib/pose/pose_layout.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "core/base/dense_solve.h"

namespace scattermeter::calib {
namespace {

// One row per pair in use.
Eigen::MatrixXd world_rows(const std::vector<PointPair>& pairs, const std::vector<bool>& use) {
  Eigen::MatrixXd rows(std::count(use.begin(), use.end(), true), 3);
  Eigen::Index row = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (use[i]) rows.row(row++) = pairs[i].world_mm;
  }
  return rows;
}

Eigen::MatrixXd image_rows(const std::vector<PointPair>& pairs, const std::vector<bool>& use) {
  Eigen::MatrixXd rows(std::count(use.begin(), use.end(), true), 2);
  Eigen::Index row = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (use[i]) rows.row(row++) = pairs[i].image_px;
  }
  return rows;
}

// Rms extent of the points about their mean along each principal direction, largest first. It is
// computed from the singular values of the points themselves, not of their scatter matrix: squaring
// would lose a spread below 1e-8 of the largest.
Eigen::VectorXd rms_spread(Eigen::MatrixXd rows) {
  const Eigen::RowVectorXd first = rows.row(0);
  rows.rowwise() -= first;  // in two steps, so that a far origin leaves no rounding in the mean
  const Eigen::RowVectorXd mean = rows.colwise().mean();
  rows.rowwise() -= mean;
  return thin_svd(rows).values / std::sqrt(static_cast<double>(rows.rows()));
}

// The number of different world points, at most `enough`, so that a thousand pairs do not cost a
// million comparisons.
int count_different(const Eigen::MatrixXd& rows, double tolerance_mm, int enough) {
  std::vector<Eigen::Vector3d> seen;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Eigen::Vector3d x = rows.row(i);
    const bool again = std::any_of(seen.begin(), seen.end(), [&](const Eigen::Vector3d& y) {
      return (x - y).norm() <= tolerance_mm;
    });
    if (!again) seen.push_back(x);
    if (static_cast<int>(seen.size()) >= enough) break;
  }
  return static_cast<int>(seen.size());
}

PoseFault world_line(double across_mm) {
  std::ostringstream out;
  out << "the world points lie on one line (rms distance from it " << std::setprecision(2)
      << across_mm << " mm), so a turn about that line does not show in the image; add points well "
      << "away from it";
  return {PoseStatus::kCollinear, out.str()};
}

}  // namespace

std::optional<PoseFault> layout_fault(const std::vector<PointPair>& pairs,
                                      const std::vector<bool>& use, double noise_std_px) {
  const Eigen::MatrixXd world = world_rows(pairs, use);
  std::ostringstream out;
  if (world.rows() < 4) {
    out << "a pose needs at least four point pairs (six or more to find a wrong one among them), "
           "got "
        << world.rows() << "; add points";
    return PoseFault{PoseStatus::kTooFewPoints, out.str()};
  }
  const Eigen::VectorXd spread_mm = rms_spread(world);
  // Rounding of the coordinates themselves does not count as spread.
  const double rounding_mm = 1e-12 * world.cwiseAbs().maxCoeff();
  if (spread_mm[0] <= rounding_mm) {
    return PoseFault{
        PoseStatus::kCollinear,
        "the world points are all at one position; give points at different positions"};
  }
  const int different = count_different(world, 1e-9 * spread_mm[0] + rounding_mm, 4);
  if (different < 4) {
    out << "the " << world.rows() << " point pairs name only " << different
        << " different positions in the world, but a pose needs four; add points at other "
           "positions";
    return PoseFault{PoseStatus::kTooFewPoints, out.str()};
  }
  if (spread_mm[1] < 1e-3 * spread_mm[0] + rounding_mm) return world_line(spread_mm[1]);

  const Eigen::VectorXd spread_px = rms_spread(image_rows(pairs, use));
  if (spread_px[0] < 4 * noise_std_px) {
    out << "the image points are all at one position (within " << std::setprecision(2)
        << spread_px[0]
        << " px rms); come closer, use points farther apart, or check the pixel coordinates";
    return PoseFault{PoseStatus::kCollinear, out.str()};
  }
  if (spread_px[1] < 3 * noise_std_px) {
    out << "the image points lie on one line (rms distance from it " << std::setprecision(2)
        << spread_px[1]
        << " px): the points' plane is seen edge-on, or pixel coordinates are wrong; "
        << "check them, or add points off the plane";
    return PoseFault{PoseStatus::kCollinear, out.str()};
  }
  return std::nullopt;
}

std::optional<PoseFault> seen_as_line_fault(const std::vector<PointPair>& pairs,
                                            const std::vector<bool>& use, double px_per_mm,
                                            double noise_std_px) {
  const Eigen::VectorXd spread_mm = rms_spread(world_rows(pairs, use));
  if (spread_mm[1] * px_per_mm < 3 * noise_std_px) return world_line(spread_mm[1]);
  return std::nullopt;
}

}  // namespace scattermeter::calib
