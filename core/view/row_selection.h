// Selection of the patches that are used, by criteria beyond the state of their samples.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/view/observation.h"

namespace scattermeter {

// Excludes a used row for the given reason and updates the counts.
void leave_out(ChannelObservation& observation, std::size_t row, RowState reason);

// Whether a smooth surface at `point_mm` mirrors a light at `light_mm` into the camera, within
// `cone_rad` of the mirror direction. normal: unit, outwards. False where light or camera are
// behind the surface.
bool mirrors(const Eigen::Vector3d& point_mm, const Eigen::Vector3d& normal,
             const Eigen::Vector3d& camera_mm, const Eigen::Vector3d& light_mm, double cone_rad);

struct RowSelectionOptions {
  // Rows whose expected l is below this many of its standard deviations are left out: there, black
  // level and stray light dominate.
  double min_snr = 3.0;
  // Rows farther from the fit than this many deviations, and than this many robust deviations of
  // all rows (kStdPerMad times the median absolute deviation), are outliers.
  double outlier_std = 6.0;
  // If more than this share of the rows were outliers the model is wrong, not the rows: none is
  // left out.
  double max_outlier_share = 0.02;
};

// Variances by the expected light instead of the measured one (which would favour rows that are
// dark by chance); rows deep in noise are left out. `expected`: predicted l of the used rows, in
// order. Call it once only: afterwards the variances are no longer those of the measured l.
void expect(ChannelObservation& observation, const Eigen::VectorXd& expected,
            const RowSelectionOptions& options = {});

// Used rows that are outliers, as row indices of the system. All arguments have the same length.
std::vector<Eigen::Index> outliers(const Eigen::VectorXd& l, const Eigen::VectorXd& predicted,
                                   const Eigen::VectorXd& std_l,
                                   const RowSelectionOptions& options = {});

}  // namespace scattermeter
