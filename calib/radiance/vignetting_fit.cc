#include "calib/radiance/vignetting_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "core/base/dense_solve.h"

namespace scattermeter::calib {
namespace {

constexpr std::size_t kRadial = 4;
constexpr std::size_t kRadialTerms = kRadial + Vignetting::kMapTerms;
using Terms = Eigen::Matrix<double, kRadialTerms, 1>;

// Mean over the samples of the block.
Terms mean_terms(const Block& b, const Vignetting& frame) {
  Terms sum = Terms::Zero(), t;
  int n = 0;
  for (int y = b.y0; y < b.y1; y += 2) {
    for (int x = b.x0; x < b.x1; x += 2) {
      Vignetting::terms((x - frame.center_px.x()) / frame.half_diagonal_px,
                        (y - frame.center_px.y()) / frame.half_diagonal_px, kRadial,
                        Vignetting::kMapTerms, t.data());
      sum += t;
      ++n;
    }
  }
  return n > 0 ? Terms(sum / n) : sum;
}

struct ColourBlocks {
  Eigen::MatrixXd terms;  // blocks x (1 + kRadialTerms), the first column 1
  Eigen::VectorXd light, weight;
  Eigen::MatrixXd shared;  // blocks x errors, in units of light
};

struct LinearFit {
  Eigen::VectorXd x;
  Eigen::MatrixXd covariance;
};

LinearFit fit_blocks(const ColourBlocks& c) {
  const Eigen::MatrixXd normal = c.terms.transpose() * c.weight.asDiagonal() * c.terms;
  const SymmetricSolver solver(normal);
  return {solver.solve(c.terms.transpose() * c.weight.cwiseProduct(c.light)), solver.inverse()};
}

}  // namespace

VignettingFit fit_vignetting(const std::vector<FlatLight>& blocks, int width_px, int height_px) {
  VignettingFit out;
  out.vignetting = vignetting_of_frame(width_px, height_px);
  std::array<ColourBlocks, kRgb> colours;
  for (std::size_t c = 0; c < kRgb; ++c) {
    std::vector<const FlatLight*> own;
    for (const FlatLight& b : blocks) {
      if (b.colour == c && b.light > 0.0 && b.variance > 0.0) own.push_back(&b);
    }
    const auto n = static_cast<Eigen::Index>(own.size());
    if (n < static_cast<Eigen::Index>(4 * kRadialTerms)) return out;
    ColourBlocks& of = colours[c];
    of.terms.resize(n, 1 + kRadialTerms);
    of.light.resize(n);
    of.weight.resize(n);
    of.shared.resize(n, own.front()->shared.size());
    for (Eigen::Index i = 0; i < n; ++i) {
      const FlatLight& b = *own[static_cast<std::size_t>(i)];
      of.terms.row(i) << 1.0, mean_terms(b.block, out.vignetting).transpose();
      of.light[i] = b.light;
      of.weight[i] = 1.0 / b.variance;
      of.shared.row(i) = b.light * b.shared.transpose();
    }
  }
  double chi2 = 0, freedom = 0, relative = 0, n = 0;
  std::array<LinearFit, kRgb> fits;
  for (std::size_t c = 0; c < kRgb; ++c) {
    fits[c] = fit_blocks(colours[c]);
    const Eigen::VectorXd predicted = colours[c].terms * fits[c].x;
    for (Eigen::Index i = 0; i < predicted.size(); ++i) {
      const double r = colours[c].light[i] - predicted[i];
      chi2 += colours[c].weight[i] * r * r;
      relative += r * r / (predicted[i] * predicted[i]);
      out.worst = std::max(out.worst, std::abs(r / predicted[i]));
      n += 1.0;
    }
    freedom += static_cast<double>(predicted.size()) - static_cast<double>(1 + kRadialTerms);
  }
  out.rms = std::sqrt(relative / n);
  out.reduced_chi2 = chi2 / freedom;
  const double widen =
      out.reduced_chi2 > 1.0 + 3.0 * std::sqrt(2.0 / freedom) ? out.reduced_chi2 : 1.0;
  for (std::size_t c = 0; c < kRgb; ++c) {
    const Eigen::VectorXd& x = fits[c].x;
    const Eigen::Index m = x.size() - 1;
    const Eigen::VectorXd factor = x.tail(m) / x[0];
    // d factor / d (A, A factor).
    Eigen::MatrixXd j(m, m + 1);
    j << -factor / x[0], Eigen::MatrixXd::Identity(m, m) / x[0];
    // Each shared error changes the estimate in proportion to its effect on the light.
    const ColourBlocks& of = colours[c];
    const Eigen::MatrixXd moved =
        fits[c].covariance * of.terms.transpose() * of.weight.asDiagonal() * of.shared;
    const Eigen::MatrixXd covariance = widen * fits[c].covariance + moved * moved.transpose();
    out.covariance[c] = j * covariance * j.transpose();
    const auto radial = static_cast<std::ptrdiff_t>(kRadial);
    out.vignetting.radial[c].assign(factor.begin(), factor.begin() + radial);
    out.vignetting.map[c].assign(factor.begin() + radial, factor.end());
  }
  double squares = 0;
  constexpr int kGrid = 8;
  for (std::size_t c = 0; c < kRgb; ++c) {
    for (int i = 0; i <= kGrid; ++i) {
      for (int k = 0; k <= kGrid; ++k) {
        const double s =
            share_std(out, (width_px - 1.0) * i / kGrid, (height_px - 1.0) * k / kGrid, c);
        squares += s * s;
        if (i % kGrid == 0 && k % kGrid == 0) out.corner_std = std::max(out.corner_std, s);
      }
    }
  }
  out.rms_std = std::sqrt(squares / (kRgb * (kGrid + 1) * (kGrid + 1)));
  out.ok = std::isfinite(out.rms_std);
  return out;
}

double share_std(const VignettingFit& fit, double x_px, double y_px, std::size_t colour) {
  const Vignetting& v = fit.vignetting;
  std::array<double, kRadialTerms> t{};
  Vignetting::terms((x_px - v.center_px.x()) / v.half_diagonal_px,
                    (y_px - v.center_px.y()) / v.half_diagonal_px, kRadial, Vignetting::kMapTerms,
                    t.data());
  const Eigen::Map<const Terms> terms(t.data());
  return std::sqrt(std::max(0.0, terms.dot(fit.covariance[colour] * terms)));
}

}  // namespace scattermeter::calib
