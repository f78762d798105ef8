// Residual figures of a re-rendering against the image.
#pragma once

#include <Eigen/Core>

namespace scattermeter {

struct Residual {
  double chi2 = 0;          // sum of ((l - predicted) / std)^2
  double rms_relative = 0;  // rms of l - predicted over rms of l
  double psnr_db = 0;       // 20 log10(largest l / rms of l - predicted); +inf for an exact match
};

// Arguments of equal length, at least 1 (std::invalid_argument).
Residual residual(const Eigen::VectorXd& l, const Eigen::VectorXd& predicted,
                  const Eigen::VectorXd& std_l);

}  // namespace scattermeter
