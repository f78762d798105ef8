// Correction of the dipole's image to that of the paths, part by part.
#pragma once

#include <Eigen/Core>

#include "core/fit/scattering_equation.h"
#include "core/fit/shot_parts.h"
#include "core/transport/scattering_rows.h"

namespace scattermeter {

// A smooth image for weighting the rows: the dipole provides the detail, paths the level. In every
// part of the shots the dipole's light is scaled to that of all paths so far, and the derivatives
// of its logarithm are shifted to theirs; the noise of the paths is a few per cent in a part, but
// tens of per cent in a row. The correlation of the errors of the cells' light is estimated from
// the same paths.
class PartLight {
 public:
  // image: from `blocks` blocks of paths; dipole: for the same medium; cell_covariance: of
  // parts.cells() * image.l, with `freedom` degrees of freedom. An image with a dark part is used
  // for the covariance only.
  void learn(const ShotParts& parts, const ScatteringImage& image,
             const Eigen::MatrixXd& cell_covariance, double freedom, const ScatteringImage& dipole,
             double blocks);
  double blocks() const { return blocks_; }

  // Two that have learnt from independent paths: the noise of a part's derivatives, which paths of
  // other media determine, may exceed the differences between parts, so each keeps only the share
  // of its parts' departures from their mean that the other confirms.
  static void confirm(PartLight& a, PartLight& b);

  // Corrects l and the derivatives of a dipole's image by what was learnt.
  void correct(const ShotParts& parts, ScatteringImage& dipole) const;

  // Covariance of the cells' relative light from one block of paths. Few degrees of freedom
  // determine the correlations of cells less well than their variances; the correlations are shrunk
  // towards zero, as otherwise some combination of cells would appear free of error. Precondition:
  // blocks() > 0.
  Eigen::MatrixXd relative_cell_covariance(const ShotParts& parts) const;

 private:
  Eigen::ArrayXd l_, per_log_sigma_s_, per_sigma_a_;  // ratio; differences
  double confirmed_s_ = 1, confirmed_a_ = 1;          // shares of these
  double learnt_ = 0;
  Eigen::MatrixXd cell_variance_;  // of one block, times the blocks
  double blocks_ = 0;
  double freedom_ = 0;  // the most so far: later images may be of the same paths
};

// Errors of `n` rows from the `first` on, with the correlation of their cells' errors. l: of all
// rows; cells: covariance of the cells' relative light.
CorrelatedErrors correlated_rows(const ShotParts& parts, const Eigen::VectorXd& l,
                                 const Eigen::MatrixXd& cells, Eigen::Index first, Eigen::Index n);

}  // namespace scattermeter
