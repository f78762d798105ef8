#include "core/diffusion/weight_store.h"

#include <vector>

#include <gtest/gtest.h>

#include "core/mesh/exit_site.h"
#include "tests/fixtures/core/memory_store.h"

namespace scattermeter {
namespace {

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
  test_support::MemoryStore<WeightMatrix> store;
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
