#include "core/diffusion/weight_store.h"

#include <cstddef>

namespace scattermeter {
namespace {

class Numbers {
 public:
  void add(double number) { all_.push_back(number); }
  template <class Derived>
  void add(const Eigen::DenseBase<Derived>& numbers) {
    for (Eigen::Index j = 0; j < numbers.cols(); ++j) {
      for (Eigen::Index i = 0; i < numbers.rows(); ++i) {
        all_.push_back(static_cast<double>(numbers(i, j)));
      }
    }
  }
  void reserve(std::size_t n) { all_.reserve(n); }
  const std::vector<double>& all() const { return all_; }

 private:
  std::vector<double> all_;
};

void add(const ExitSite& site, Numbers& out) {
  out.add(site.center_mm);
  out.add(site.covariance_mm2);
  out.add(site.n_points);
  for (std::size_t i = 0; i < static_cast<std::size_t>(site.n_points); ++i) {
    out.add(site.points_mm[i]);
    out.add(site.weights[i]);
  }
  out.add(site.n_few);
  for (std::size_t i = 0; i < static_cast<std::size_t>(site.n_few); ++i) out.add(site.few_mm[i]);
}

// The triangle and its density, from which its points and its place in the tree follow.
void add(const SourceCloud::Rule& rule, Numbers& out) {
  out.add(rule.precise_center);
  for (const Eigen::Vector3f& corner : rule.corner) out.add(corner);
  for (const float rise : rule.rise) out.add(rise);
  out.add(rule.density);
}

Numbers numbers_of(const std::vector<ExitSite>& sites, const SourceCloud& sources,
                   const DistanceKnots& knots, const PairSumOptions& options) {
  constexpr std::size_t kOfSite = 70, kOfRule = 16;
  // To be raised when the same inputs give other digits.
  constexpr int kForm = 2;
  Numbers out;
  out.reserve(kOfSite * sites.size() + kOfRule * sources.size() + 32);
  out.add(kForm);
  out.add(knots.resolution_mm());
  out.add(knots.max_distance_mm());
  out.add(knots.size());
  out.add(knots.fine_bins().size());
  out.add(options.far_ratio);
  out.add(options.near_ratio);
  out.add(options.few_points_ratio);
  out.add(options.floor_mm);
  out.add(sources.origin_mm());
  out.add(static_cast<double>(sites.size()));
  for (const ExitSite& site : sites) add(site, out);
  for (const SourceCloud::Rule& rule : sources.rules()) add(rule, out);
  return out;
}

}  // namespace

WeightMatrix smooth_weights(const std::vector<ExitSite>& sites, const SourceCloud& sources,
                            const DistanceKnots& knots, const PairSumOptions& options,
                            WeightStore* store) {
  if (store == nullptr) return smooth_weights(sites, sources, knots, options);
  return found_or_made(*store, numbers_of(sites, sources, knots, options).all(),
                       [&] { return smooth_weights(sites, sources, knots, options); });
}

}  // namespace scattermeter
