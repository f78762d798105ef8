#include "core/path_blocks.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "tests/core/boxes.h"

namespace scattermeter {
namespace {

TEST(PathBlocks, MergesInOrder) {
  std::vector<int> seen;
  run_in_order(
      3, 200, [](int i) { return std::make_shared<int>(7 * i); },
      [&](int i, void* result) {
        EXPECT_EQ(*static_cast<int*>(result), 7 * i);
        seen.push_back(i);
      });
  ASSERT_EQ(seen.size(), 197U);
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], static_cast<int>(i) + 3);
}

struct Sums {
  double escaped = 0, seen = 0;
  void escape(const PathScore& s) { escaped += s.weight * s.point_mm.x() * s.length_mm; }
  void camera(const PathScore& s) { seen += s.weight * s.scatterings; }
};

// The same digits for any number of threads.
TEST(PathBlocks, DigitsDoNotDependOnThreads) {
  const RayScene scene(testing::make_cube());
  const PathBoundary boundary(scene);
  const ScatteringMedium medium{1.0, 0.02, 0.2, 1.3};
  Led led;
  led.position_mm = {30, -60, 80};
  led.axis = Eigen::Vector3d(-0.3, 0.6, -0.7).normalized();
  const auto source = led_entry(scene, led, 1.3);
  const CameraConnection camera(boundary, {0, -100, 150}, medium);
  PathOptions options;
  options.paths_per_block = 100;
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    Sums total;
    trace_blocks<Sums>(
        {boundary, medium, *source, &camera}, options, 0, 20, [] { return Sums(); },
        [&](const Sums& s, const PathAudit&) {
          total.escaped += s.escaped;
          total.seen += s.seen;
        });
    return total;
  };
  const Sums one = run(1), many = run(8);
  EXPECT_EQ(one.escaped, many.escaped);
  EXPECT_EQ(one.seen, many.seen);
  EXPECT_GT(one.seen, 0.0);
}

}  // namespace
}  // namespace scattermeter
