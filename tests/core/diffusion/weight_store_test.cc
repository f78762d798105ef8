#include "core/diffusion/weight_store.h"

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/mesh/exit_site.h"

namespace scattermeter {
namespace {

class MapStore : public WeightStore {
 public:
  std::string name(const std::vector<double>& numbers) const override {
    std::string out;
    for (const double x : numbers) out += std::to_string(x) + " ";
    return out;
  }
  std::optional<WeightMatrix> find(const std::string& name) override {
    const auto at = kept.find(name);
    if (at == kept.end()) return std::nullopt;
    ++found;
    return at->second;
  }
  void keep(const std::string& name, const WeightMatrix& weights) override { kept[name] = weights; }
  std::map<std::string, WeightMatrix> kept;
  int found = 0;
};

IncidentLight lit_triangle(double top) {
  IncidentLight out;
  out.lit.push_back({{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)},
                     {1e-4, 1e-4, top},
                     0});
  return out;
}

// Whatever changes W changes its name; the digits are those of W that is not kept.
TEST(WeightStore, KeepsEachInputApart) {
  const Eigen::Vector3d origin(0, 0, 0);
  const std::vector<ExitSite> sites{exit_point({3, 0, 0}), exit_point({0, 4, 1})};
  const SourceCloud light(lit_triangle(2e-4), origin);
  const DistanceKnots knots(0.05, 20.0);
  const PairSumOptions options;
  MapStore store;
  const WeightMatrix w = smooth_weights(sites, light, knots, options, &store);
  EXPECT_EQ(w, smooth_weights(sites, light, knots, options));
  EXPECT_EQ(w, w.cast<float>().cast<double>());
  EXPECT_EQ(smooth_weights(sites, light, knots, options, &store), w);
  EXPECT_EQ(store.found, 1);
  std::size_t n = 1;
  const auto is_new = [&] { return store.found == 1 && store.kept.size() == ++n; };
  smooth_weights({sites[1], sites[0]}, light, knots, options, &store);
  EXPECT_TRUE(is_new());
  smooth_weights({sites[0]}, light, knots, options, &store);
  EXPECT_TRUE(is_new());
  smooth_weights(sites, SourceCloud(lit_triangle(3e-4), origin), knots, options, &store);
  EXPECT_TRUE(is_new());
  smooth_weights(sites, light, DistanceKnots(0.05, 20.0, 3), options, &store);
  EXPECT_TRUE(is_new());
  smooth_weights(sites, light, DistanceKnots(0.05, 20.0, 6, 5), options, &store);
  EXPECT_TRUE(is_new());
  PairSumOptions other = options;
  other.far_ratio = 3.0;
  smooth_weights(sites, light, knots, other, &store);
  EXPECT_TRUE(is_new());
}

}  // namespace
}  // namespace scattermeter
