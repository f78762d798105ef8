// What the dipole lacks, part by part.
#pragma once

#include <Eigen/Core>

#include "core/fit/shot_parts.h"
#include "core/transport/scattering_rows.h"

namespace scattermeter {

// A smooth image to weight rows by: the dipole provides the detail, paths the level. In every part
// of the shots the dipole's light is brought to that of all paths so far, and the derivatives of
// its logarithm to theirs; in the parts, paths are noisy by per cents, not by tens as in the rows.
// It also holds how the errors of the cells' light are correlated, from as many paths.
class PartLight {
 public:
  void forget() { *this = {}; }
  // image: by `blocks` blocks of paths, dipole: at the same medium; cell_covariance: of
  // parts.cells() * image.l. An image of which a part is dark only counts for the covariance.
  void learn(const ShotParts& parts, const ScatteringImage& image,
             const Eigen::MatrixXd& cell_covariance, const ScatteringImage& dipole, int blocks);
  double blocks() const { return blocks_; }

  // Brings l and the derivatives of a dipole's image up to what was learnt.
  void correct(const ShotParts& parts, ScatteringImage& dipole) const;

  // Covariance of the cells' relative light from one block of paths. Few blocks
  // determine the correlations of cells less well than their variances: these are shrunk towards
  // zero, or some combination would look free of error for lack of blocks. Precondition: blocks() >
  // 0.
  Eigen::MatrixXd relative_cell_covariance(const ShotParts& parts) const;

 private:
  Eigen::ArrayXd l_, per_log_sigma_s_, per_sigma_a_;  // ratio; differences
  double learnt_ = 0;
  Eigen::MatrixXd cell_variance_;  // of one block, times the blocks
  double blocks_ = 0;
};

// Errors of rows that are correlated as those of their cells are: columns of unit deviation. l: of
// the rows; cells: covariance of the cells' relative light.
Eigen::MatrixXd correlated_rows(const ShotParts& parts, const Eigen::VectorXd& l,
                                const Eigen::MatrixXd& cells);

}  // namespace scattermeter
