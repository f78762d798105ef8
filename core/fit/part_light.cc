#include "core/fit/part_light.h"

#include <algorithm>
#include <vector>

#include "core/base/covariance_root.h"

namespace scattermeter {

void PartLight::learn(const ShotParts& parts, const ScatteringImage& image,
                      const Eigen::MatrixXd& cell_covariance, double freedom,
                      const ScatteringImage& dipole, double blocks) {
  const double n = blocks;
  freedom_ = std::max(freedom_, freedom);
  if (blocks_ == 0.0) cell_variance_ = 0.0 * cell_covariance;
  cell_variance_ += n * n * cell_covariance;
  blocks_ += n;
  const auto light = [&](const Eigen::VectorXd& l) -> Eigen::ArrayXd { return parts.of_parts(l); };
  const Eigen::ArrayXd own = light(image.l);
  const Eigen::ArrayXd dipoles = light(dipole.l);
  if (!(own.minCoeff() > 0.0 && dipoles.minCoeff() > 0.0)) return;
  const Eigen::ArrayXd l = (own / dipoles).max(0.2).min(5.0);
  const Eigen::ArrayXd s =
      light(image.per_log_sigma_s) / own - light(dipole.per_log_sigma_s) / dipoles;
  const Eigen::ArrayXd a = light(image.per_sigma_a) / own - light(dipole.per_sigma_a) / dipoles;
  if (learnt_ == 0.0) l_ = per_log_sigma_s_ = per_sigma_a_ = Eigen::ArrayXd::Zero(own.size());
  learnt_ += n;
  const double share = n / learnt_;
  l_ += share * (l - l_);
  per_log_sigma_s_ += share * (s - per_log_sigma_s_);
  per_sigma_a_ += share * (a - per_sigma_a_);
}

void PartLight::confirm(PartLight& a, PartLight& b) {
  if (a.learnt_ == 0.0 || b.learnt_ == 0.0) return;
  const auto share = [](const Eigen::ArrayXd& x, const Eigen::ArrayXd& y) {
    const Eigen::ArrayXd dx = x - x.mean(), dy = y - y.mean();
    const double own = 0.5 * (dx.square().sum() + dy.square().sum());
    return own > 0.0 ? std::max(0.0, (dx * dy).sum() / own) : 0.0;
  };
  a.confirmed_s_ = b.confirmed_s_ = share(a.per_log_sigma_s_, b.per_log_sigma_s_);
  a.confirmed_a_ = b.confirmed_a_ = share(a.per_sigma_a_, b.per_sigma_a_);
}

void PartLight::correct(const ShotParts& parts, ScatteringImage& dipole) const {
  if (learnt_ == 0.0) return;
  const auto kept = [](const Eigen::ArrayXd& x, double share) -> Eigen::ArrayXd {
    return x.mean() + share * (x - x.mean());
  };
  const Eigen::ArrayXd s = kept(per_log_sigma_s_, confirmed_s_);
  const Eigen::ArrayXd a = kept(per_sigma_a_, confirmed_a_);
  for (Eigen::Index j = 0; j < dipole.l.size(); ++j) {
    const Eigen::Index part = parts.part_of_row(j);
    const double l = dipole.l[j];
    const double ratio = l_[part];
    dipole.l[j] *= ratio;
    dipole.per_log_sigma_s[j] = ratio * (dipole.per_log_sigma_s[j] + l * s[part]);
    dipole.per_sigma_a[j] = ratio * (dipole.per_sigma_a[j] + l * a[part]);
  }
}

Eigen::MatrixXd PartLight::relative_cell_covariance(const ShotParts& parts) const {
  // Cells of one shot; those of others share few paths.
  constexpr double kCells = 64.0;
  const double cells = std::min(kCells, static_cast<double>(parts.n_cells()));
  const double share = freedom_ / (freedom_ + cells);
  Eigen::MatrixXd out = share / blocks_ * cell_variance_;
  out.diagonal() = cell_variance_.diagonal() / blocks_;
  return out;
}

CorrelatedErrors correlated_rows(const ShotParts& parts, const Eigen::VectorXd& l,
                                 const Eigen::MatrixXd& cells, Eigen::Index first, Eigen::Index n) {
  std::vector<Eigen::Index> touched;
  for (Eigen::Index j = first; j < first + n; ++j) touched.push_back(parts.cell_of_row(j));
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  CorrelatedErrors out;
  out.root = covariance_root(cells(touched, touched));
  out.of_row.resize(n, static_cast<Eigen::Index>(touched.size()));
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto group =
        std::lower_bound(touched.begin(), touched.end(), parts.cell_of_row(first + j));
    out.of_row.insert(j, group - touched.begin()) = l[first + j];
  }
  out.of_row.makeCompressed();
  return out;
}

}  // namespace scattermeter
