#include "core/sums/cluster_verdicts.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/sums/kernel_bounds.h"

namespace scattermeter {
namespace {

// Every verdict holds by the tables in double precision: what is dropped gives no more than the
// share, a series' rest is told no smaller than it is, distances no larger.
TEST(ClusterVerdicts, HoldByTheTables) {
  const KernelDipole dipole{0.5, 1.2, 0.1};
  const KernelBounds bounds({&dipole, 1});
  constexpr std::size_t kCells = KernelBounds::kCells, kReaches = KernelBounds::kReaches;
  std::vector<float> need(std::size(kDegrees) * kReaches * kCells), all(kCells);
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    all[cell] = bounds.largest(0, cell)[0];
    for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
      for (std::size_t r = 0; r < kReaches; ++r) {
        need[(i * kReaches + r) * kCells + cell] = bounds.rest(0, i, r, cell)[0];
      }
    }
  }
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<ClusterTraits> traits(997);
  std::vector<std::int32_t> nodes;
  for (std::size_t k = 0; k < traits.size(); ++k) {
    ClusterTraits& t = traits[k];
    const double reach = std::pow(10.0, 4.0 * uniform(random) - 1.0);
    for (float& x : t.center_mm) x = static_cast<float>(reach * (2.0 * uniform(random) - 1.0));
    t.radius_mm = static_cast<float>(std::pow(10.0, 3.0 * uniform(random) - 2.0));
    t.weight = static_cast<float>(std::pow(10.0, -3.0 * uniform(random)));
    t.last = static_cast<std::int32_t>(random() % 6) - 1;
    for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
      t.spread[i] = 0.3F * t.weight / (i == 0 ? 1.0F : t.radius_mm);
    }
    nodes.push_back(static_cast<std::int32_t>(traits.size() - 1 - k));
  }
  VerdictRegion place{{3.0F, -1.0F, 0.5F},
                      0.7F,
                      1e-4F,
                      0.9F,
                      1e-5F,
                      0.5F,
                      1.2F,
                      static_cast<float>(bounds.cells_per_mm()),
                      need.data(),
                      all.data(),
                      bounds.tails()};
  for (const char* set : {"SSE4", "AVX2", "AVX3", ""}) {
    if (!choose_kernel_instruction_set(set)) continue;
    std::vector<std::int32_t> verdict(nodes.size() + kRowLanes);
    std::vector<float> rests(verdict.size()), nearest_mm(verdict.size());
    judge_clusters(traits.data(), nodes, place, {verdict.data(), rests.data(), nearest_mm.data()});
    std::size_t opened = 0, dropped = 0, summed = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const ClusterTraits& t = traits[static_cast<std::size_t>(nodes[k])];
      double center2 = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        center2 += std::pow(double(t.center_mm[i]) - double(place.center_mm[i]), 2);
      }
      const double a = double(t.radius_mm), center = std::sqrt(center2);
      const double d = std::max(0.0, center - double(place.radius_mm));
      const double rho = std::hypot(d, 0.5);
      if (verdict[k] == kVerdictOpen) {
        ++opened;
      } else if (verdict[k] == kVerdictDrop) {
        ++dropped;
        EXPECT_GT(nearest_mm[k], 0.0F);
        EXPECT_LE(double(nearest_mm[k]), d - a);
        const double light = double(t.weight) * double(all[bounds.cell(double(nearest_mm[k]))]);
        EXPECT_LE(light, double(place.share) * (1.0 + 1e-4)) << set << " " << k;
      } else {
        ++summed;
        const auto i = static_cast<std::size_t>(verdict[k]);
        ASSERT_LE(verdict[k], t.last);
        EXPECT_LT(a, KernelBounds::kLargestRatio * rho);
        EXPECT_LE(double(nearest_mm[k]), rho);
        const std::size_t cell = bounds.cell(d);
        const std::size_t reach =
            KernelBounds::reach(cell, bounds.cell(center + double(place.radius_mm)));
        const auto ratio = static_cast<std::size_t>(32.0 * a / rho);
        const double factor = double(t.spread[i]) * (i == 0 ? 1.0 : a) *
                              double(need[(i * kReaches + reach) * kCells + cell]) *
                              double(bounds.tail(i, reach, cell, ratio));
        const double rest = factor * std::pow(a, kDegrees[i] + 1) / std::pow(rho, kFalls[i]);
        EXPECT_GE(double(rests[k]), rest) << set << " " << k << " series " << i;
        // A little nearer a cell of the tables may be the one before.
        EXPECT_LE(double(rests[k]), 1.3 * rest) << set << " " << k << " series " << i;
      }
    }
    // Few of the clusters are near, few are dim.
    EXPECT_GT(opened, nodes.size() / 50) << set;
    EXPECT_GT(dropped, nodes.size() / 50) << set;
    EXPECT_GT(summed, nodes.size() / 50) << set;
  }
  choose_kernel_instruction_set("");
}

}  // namespace
}  // namespace scattermeter
