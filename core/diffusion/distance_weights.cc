#include "core/diffusion/distance_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <stdexcept>
#include <string>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace scattermeter {
namespace {

// Lagrange's polynomial through the knots 0 .. kStencil - 1 at u: their weights.
template <int kStencil>
std::array<double, kStencil> lagrange(double u) {
  std::array<double, kStencil> w;
  for (int a = 0; a < kStencil; ++a) {
    double product = 1.0;
    for (int b = 0; b < kStencil; ++b) {
      if (b != a) product *= (u - b) / static_cast<double>(a - b);
    }
    w[static_cast<std::size_t>(a)] = product;
  }
  return w;
}

}  // namespace

DistanceKnots::DistanceKnots(double resolution_mm, double max_distance_mm, int per_octave,
                             int fine_bits)
    : resolution_mm_(resolution_mm),
      max_distance_mm_(max_distance_mm),
      per_octave_(per_octave),
      bins_(resolution_mm * resolution_mm, max_distance_mm, fine_bits) {
  if (!(resolution_mm > 0.0) || !(max_distance_mm > resolution_mm) || per_octave < 1 ||
      fine_bits < 4 || fine_bits > 12) {
    throw std::invalid_argument("DistanceKnots: resolution " + std::to_string(resolution_mm) +
                                " mm, longest distance " + std::to_string(max_distance_mm) + " mm");
  }
  const double s0 = bins_.s0_mm2();
  const double octaves = std::log2(bins_.knot_s_mm2(bins_.size() - 1) / s0);
  const int n = std::max(kStencil, static_cast<int>(std::ceil(octaves * per_octave)) + 1);
  for (int j = 0; j < n; ++j) {
    const double s = s0 * std::exp2(static_cast<double>(j) / per_octave);
    knots_mm_.push_back(std::sqrt(std::max(0.0, s - s0)));
  }
  const auto first_knot = [&](int bin) {
    const double u = std::log2(bins_.knot_s_mm2(bin) / s0) * per_octave;
    // A bin on a knot belongs to the interval beyond it.
    return std::clamp(static_cast<int>(std::floor(u + 1e-9)) - kStencil / 2 + 1, 0, n - kStencil);
  };
  // Where runs of other octaves have the same shares: by the first bin and knot, less octaves.
  std::map<std::array<int, 3>, std::size_t> known;
  const int octave_bins = 1 << fine_bits;
  for (int i = 0; i < bins_.size();) {
    Run run{0, first_knot(i), shares_.size()};
    const int begin = i;
    while (i < bins_.size() && first_knot(i) == run.first_knot) ++i;
    run.bins = i - begin;
    const int octave = begin / octave_bins;
    const bool has_both_sides = begin > 0 && i < bins_.size();
    const std::array<int, 3> key{begin % octave_bins, run.first_knot - octave * per_octave,
                                 run.bins};
    const auto [it, is_new] = known.try_emplace(key, shares_.size());
    run.shares = it->second;
    if (is_new || !has_both_sides) {
      run.shares = shares_.size();
      for (int k = begin; k < i; ++k) shares_.push_back(shares(k, run.first_knot));
    }
    runs_.push_back(run);
  }
}

DistanceKnots::Shares DistanceKnots::shares(int bin, int first_knot) const {
  const double s0 = bins_.s0_mm2();
  const double s = bins_.knot_s_mm2(bin);
  const auto at = [&](double s_here) {
    return lagrange<kStencil>(std::log2(s_here / s0) * per_octave_ - first_knot);
  };
  // Linear shares between fine bins overestimate on average by h^2 / 12 of the second derivative,
  // h being the distance to the next bin; half of the pairs come from either side.
  const double below = bin > 0 ? s - bins_.knot_s_mm2(bin - 1) : 0.0;
  const double above = bin + 1 < bins_.size() ? bins_.knot_s_mm2(bin + 1) - s : 0.0;
  const double step = 1e-3 * s;
  const double curvature = (below * below + above * above) / 24.0 / (step * step);
  const auto here = at(s), before = at(s - step), behind = at(s + step);
  Shares out = Shares::Zero();
  for (std::size_t a = 0; a < here.size(); ++a) {
    out[static_cast<Eigen::Index>(a)] =
        static_cast<float>(here[a] - curvature * (before[a] - 2.0 * here[a] + behind[a]));
  }
  return out;
}

void DistanceKnots::fold(const float* fine, double* out) const {
  std::fill(out, out + size(), 0.0);
  int bin = 0;
  for (const Run& run : runs_) {
    Shares sum = Shares::Zero();
    const Shares* of_bin = shares_.data() + run.shares;
    for (int i = 0; i < run.bins; ++i, ++bin) sum += of_bin[i] * OctaveBins::of_knot(fine, bin);
    for (int a = 0; a < kStencil; ++a) out[run.first_knot + a] += static_cast<double>(sum[a]);
  }
}

namespace {

// use(row, its W): rows in parallel, each by one thread.
template <class Use>
void for_smooth_rows(const std::vector<ExitSite>& sites, const SourceCloud& sources,
                     const DistanceKnots& knots, const PairSumOptions& options, const Use& use) {
  const auto sums = static_cast<std::size_t>(knots.fine_bins().sums());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, (sites.size() + kSitesSideBySide - 1) / kSitesSideBySide),
      [&](const tbb::blocked_range<std::size_t>& range) {
        std::vector<float> fine(kSitesSideBySide * sums);
        Eigen::RowVectorXd w(knots.size());
        for (std::size_t block = range.begin(); block < range.end(); ++block) {
          const std::size_t first = block * kSitesSideBySide;
          const auto some =
              std::span(sites).subspan(first, std::min(kSitesSideBySide, sites.size() - first));
          std::fill(fine.begin(), fine.end(), 0.0F);
          add_pair_sums(sources, some, knots.fine_bins(), options, fine.data());
          for (std::size_t j = 0; j < some.size(); ++j) {
            knots.fold(fine.data() + j * sums, w.data());
            w = w.cast<float>().eval().cast<double>();
            use(static_cast<Eigen::Index>(first + j), w);
          }
        }
      });
}

}  // namespace

WeightMatrix smooth_weights(const std::vector<ExitSite>& sites, const SourceCloud& sources,
                            const DistanceKnots& knots, const PairSumOptions& options) {
  WeightMatrix out(static_cast<Eigen::Index>(sites.size()), knots.size());
  for_smooth_rows(sites, sources, knots, options,
                  [&](Eigen::Index row, const Eigen::RowVectorXd& w) { out.row(row) = w; });
  return out;
}

Eigen::MatrixXd smooth_images(const std::vector<ExitSite>& sites, const SourceCloud& sources,
                              const DistanceKnots& knots, const PairSumOptions& options,
                              const Eigen::MatrixXd& r) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(sites.size()), r.cols());
  for_smooth_rows(sites, sources, knots, options,
                  [&](Eigen::Index row, const Eigen::RowVectorXd& w) { out.row(row) = w * r; });
  return out;
}

WeightMatrix uniform_weights(const std::vector<ExitSite>& sites, const SourceCloud& sources,
                             const UniformBins& bins, const PairSumOptions& options) {
  WeightMatrix w = WeightMatrix::Zero(static_cast<Eigen::Index>(sites.size()), bins.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sites.size(), 16),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      add_pair_sums(sources, std::span(sites).subspan(range.begin(), range.size()),
                                    bins, options,
                                    w.row(static_cast<Eigen::Index>(range.begin())).data());
                    });
  return w;
}

}  // namespace scattermeter
