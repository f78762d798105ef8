#include "core/distance_weights.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace scattermeter {
namespace {

constexpr int kFineBits = 8;  // 256 fine bins an octave: 7e-6 by linear interpolation

template <class Row>
void for_rows(std::size_t n, const Row& row) {
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, n, 16),
      [&](const tbb::blocked_range<std::size_t>& range) { row(range.begin(), range.end()); });
}

}  // namespace

DistanceKnots::DistanceKnots(double resolution_mm, double max_distance_mm, int per_octave)
    : resolution_mm_(resolution_mm),
      max_distance_mm_(max_distance_mm),
      bins_(resolution_mm * resolution_mm, max_distance_mm, kFineBits) {
  if (!(resolution_mm > 0.0) || !(max_distance_mm > resolution_mm) || per_octave < 1) {
    throw std::invalid_argument("DistanceKnots: resolution " + std::to_string(resolution_mm) +
                                " mm, longest distance " + std::to_string(max_distance_mm) + " mm");
  }
  const double s0 = bins_.s0_mm2();
  const double octaves = std::log2(bins_.knot_s_mm2(bins_.size() - 1) / s0);
  const int n = std::max(4, static_cast<int>(std::ceil(octaves * per_octave)) + 1);
  for (int j = 0; j < n; ++j) {
    const double s = s0 * std::exp2(static_cast<double>(j) / per_octave);
    knots_mm_.push_back(std::sqrt(std::max(0.0, s - s0)));
  }
  for (int i = 0; i < bins_.size(); ++i) {
    const double u = std::log2(bins_.knot_s_mm2(i) / s0) * per_octave;
    Stencil stencil{};
    stencil.first = std::clamp(static_cast<int>(std::floor(u)) - 1, 0, n - 4);
    // Lagrange's cubic through four neighbouring knots.
    for (int a = 0; a < 4; ++a) {
      double w = 1.0;
      for (int b = 0; b < 4; ++b) {
        if (b != a) w *= (u - (stencil.first + b)) / static_cast<double>(a - b);
      }
      stencil.weight[a] = w;
    }
    stencils_.push_back(stencil);
  }
}

void DistanceKnots::fold(const double* fine, double* out) const {
  std::fill(out, out + size(), 0.0);
  // Bins between the same knots, in a row, share their four.
  for (std::size_t i = 0; i < stencils_.size();) {
    const int first = stencils_[i].first;
    Eigen::Array4d sum = Eigen::Array4d::Zero();
    for (; i < stencils_.size() && stencils_[i].first == first; ++i) {
      sum += stencils_[i].weight * fine[i];
    }
    Eigen::Map<Eigen::Array4d>(out + first) += sum;
  }
}

WeightMatrix smooth_weights(const std::vector<ExitSite>& sites, const SourceCloud& sources,
                            const DistanceKnots& knots, const PairSumOptions& options) {
  WeightMatrix w(static_cast<Eigen::Index>(sites.size()), knots.size());
  for_rows(sites.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<double> fine(static_cast<std::size_t>(knots.fine_bins().size()));
    for (std::size_t j = begin; j < end; ++j) {
      std::fill(fine.begin(), fine.end(), 0.0);
      sources.add_to(sites[j], knots.fine_bins(), options, fine.data());
      knots.fold(fine.data(), w.row(static_cast<Eigen::Index>(j)).data());
    }
  });
  return w;
}

Eigen::MatrixXd smooth_images(const std::vector<ExitSite>& sites, const SourceCloud& sources,
                              const DistanceKnots& knots, const PairSumOptions& options,
                              const Eigen::MatrixXd& r) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(sites.size()), r.cols());
  for_rows(sites.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<double> fine(static_cast<std::size_t>(knots.fine_bins().size()));
    Eigen::RowVectorXd w(knots.size());
    for (std::size_t j = begin; j < end; ++j) {
      std::fill(fine.begin(), fine.end(), 0.0);
      sources.add_to(sites[j], knots.fine_bins(), options, fine.data());
      knots.fold(fine.data(), w.data());
      out.row(static_cast<Eigen::Index>(j)) = w * r;
    }
  });
  return out;
}

WeightMatrix uniform_weights(const std::vector<ExitSite>& sites, const SourceCloud& sources,
                             const UniformBins& bins, const PairSumOptions& options) {
  WeightMatrix w = WeightMatrix::Zero(static_cast<Eigen::Index>(sites.size()), bins.size());
  for_rows(sites.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      sources.add_to(sites[j], bins, options, w.row(static_cast<Eigen::Index>(j)).data());
    }
  });
  return w;
}

}  // namespace scattermeter
