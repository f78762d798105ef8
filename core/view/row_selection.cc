#include "core/view/row_selection.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/median.h"

namespace scattermeter {

void leave_out(ChannelObservation& observation, std::size_t row, RowState reason) {
  if (observation.state.at(row) != RowState::kUsed) return;
  observation.state[row] = reason;
  --observation.rows_used;
}

bool mirrors(const Eigen::Vector3d& point_mm, const Eigen::Vector3d& normal,
             const Eigen::Vector3d& camera_mm, const Eigen::Vector3d& light_mm, double cone_rad) {
  const Eigen::Vector3d to_camera = (camera_mm - point_mm).normalized();
  const Eigen::Vector3d to_light = (light_mm - point_mm).normalized();
  if (!(normal.dot(to_camera) > 0.0) || !(normal.dot(to_light) > 0.0)) return false;
  const Eigen::Vector3d mirrored = 2.0 * normal.dot(to_camera) * normal - to_camera;
  return mirrored.dot(to_light) > std::cos(cone_rad);
}

void expect(ChannelObservation& observation, const Eigen::VectorXd& expected,
            const RowSelectionOptions& options) {
  if (expected.size() != static_cast<Eigen::Index>(observation.rows_used)) {
    throw std::invalid_argument("expect: not one value for every used row");
  }
  Eigen::Index at = 0;
  for (std::size_t j = 0; j < observation.l.size(); ++j) {
    if (observation.state[j] != RowState::kUsed) continue;
    const double l = std::max(0.0, expected[at++]);
    // The measured variance includes max(l, 0) times the slope.
    const double change = observation.variance_per_l[j] * (l - std::max(0.0, observation.l[j]));
    // Photon noise cannot take more than the variance it was part of.
    observation.variance[j] =
        std::max(observation.variance[j] + change, observation.variance_per_l[j] * l);
    if (l < options.min_snr * std::sqrt(observation.variance[j])) {
      leave_out(observation, j, RowState::kNoise);
    }
  }
}

std::vector<Eigen::Index> outliers(const Eigen::VectorXd& l, const Eigen::VectorXd& predicted,
                                   const Eigen::VectorXd& std_l,
                                   const RowSelectionOptions& options) {
  if (l.size() != predicted.size() || l.size() != std_l.size()) {
    throw std::invalid_argument("outliers: lengths differ");
  }
  std::vector<Eigen::Index> out;
  if (l.size() == 0) return out;
  const Eigen::VectorXd z = (l - predicted).cwiseQuotient(std_l).cwiseAbs();
  const double middle = upper_median(std::vector<double>(z.begin(), z.end()));
  const double limit = options.outlier_std * std::max(1.0, kStdPerMad * middle);
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    if (z[j] > limit) out.push_back(j);
  }
  if (static_cast<double>(out.size()) > options.max_outlier_share * static_cast<double>(z.size())) {
    out.clear();
  }
  return out;
}

}  // namespace scattermeter
