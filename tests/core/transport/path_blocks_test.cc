#include "core/transport/path_blocks.h"

#include <atomic>
#include <barrier>
#include <thread>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "tests/fixtures/core/boxes.h"

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

// Processes, as threads of this one.
class ThreadPeers : public PathPeers {
 public:
  struct Room {
    explicit Room(int n) : meeting(n), numbers(static_cast<std::size_t>(n)) {}
    std::barrier<> meeting;
    std::vector<std::vector<double>> numbers;
  };
  ThreadPeers(Room& room, int place) : room_(room), rank_(place) {}
  int count() const override { return static_cast<int>(room_.numbers.size()); }
  int rank() const override { return rank_; }
  std::vector<double> gathered(std::uint64_t task, const std::vector<double>& mine) override {
    tasks.push_back(task);
    room_.numbers[static_cast<std::size_t>(rank_)] = mine;
    room_.meeting.arrive_and_wait();
    std::vector<double> all;
    for (const auto& n : room_.numbers) all.insert(all.end(), n.begin(), n.end());
    room_.meeting.arrive_and_wait();
    return all;
  }
  std::vector<std::uint64_t> tasks;

 private:
  Room& room_;
  int rank_;
};

TEST(PathBlocks, PeersMergeAllInOrder) {
  for (const int count : {1, 3, 70}) {
    ThreadPeers::Room room(count);
    std::vector<std::vector<double>> seen(static_cast<std::size_t>(count));
    std::vector<int> worked(static_cast<std::size_t>(count));
    std::vector<std::thread> threads;
    for (int place = 0; place < count; ++place) {
      threads.emplace_back([&, place] {
        ThreadPeers peers(room, place);
        const auto own = static_cast<std::size_t>(place);
        std::atomic<int> calls = 0;
        share_in_order(
            peers, 5, 7, 150,
            [&](int i, std::vector<double>& numbers) {
              ++calls;
              numbers.insert(numbers.end(), {1.0 * i, 0.1 * i});
            },
            [&](int i, const double* numbers) {
              EXPECT_EQ(numbers[0], 1.0 * i);
              EXPECT_EQ(numbers[1], 0.1 * i);
              seen[own].push_back(numbers[0]);
            });
        worked[own] = calls;
        EXPECT_EQ(peers.tasks.size(), 3U);  // 143 blocks, 64 at a time
      });
    }
    for (std::thread& t : threads) t.join();
    int sum = 0;
    for (const int n : worked) sum += n;
    EXPECT_EQ(sum, 143) << "each block is one peer's";
    for (const auto& s : seen) {
      ASSERT_EQ(s.size(), 143U);
      for (std::size_t i = 0; i < s.size(); ++i) EXPECT_EQ(s[i], static_cast<double>(i) + 7.0);
    }
  }
}

struct Sums {
  double escaped = 0, seen = 0;
  template <class F>
  void numbers(const F& f) {
    f(escaped);
    f(seen);
  }
  void escape(const PathScore& s) { escaped += s.weight * s.point_mm.x() * s.length_mm; }
  void camera(const PathScore& s) { seen += s.weight * s.scatterings; }
};

// The same digits for any number of threads, and of peers.
TEST(PathBlocks, DigitsDoNotDependOnThreadsOrPeers) {
  const RayScene scene(test_support::make_cube());
  const PathBoundary boundary(scene);
  const ScatteringMedium medium{1.0, 0.02, 0.2, 1.3};
  Led led;
  led.position_mm = {30, -60, 80};
  led.axis = Eigen::Vector3d(-0.3, 0.6, -0.7).normalized();
  const auto source = led_entry(scene, led, 1.3);
  const CameraConnection camera(boundary, {0, -100, 150}, medium);
  PathOptions options;
  options.paths_per_block = 100;
  PathAudit audit;
  const auto sums = [&](const PathOptions& o) {
    Sums total;
    audit = {};
    trace_blocks<Sums>(
        {boundary, medium, *source, &camera}, o, 0, 20, [] { return Sums(); },
        [&](const Sums& s, const PathAudit& a) {
          total.escaped += s.escaped;
          total.seen += s.seen;
          audit += a;
        });
    return total;
  };
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return sums(options);
  };
  const Sums one = run(1), many = run(8);
  EXPECT_EQ(one.escaped, many.escaped);
  EXPECT_EQ(one.seen, many.seen);
  EXPECT_GT(one.seen, 0.0);
  const PathAudit expected = audit;
  ThreadPeers::Room room(3);
  std::vector<std::thread> threads;
  for (int place = 0; place < 3; ++place) {
    threads.emplace_back([&, place] {
      ThreadPeers peers(room, place);
      PathOptions shared = options;
      shared.peers = &peers;
      Sums total;
      PathAudit own;
      trace_blocks<Sums>(
          {boundary, medium, *source, &camera}, shared, 0, 20, [] { return Sums(); },
          [&](const Sums& s, const PathAudit& a) {
            total.escaped += s.escaped;
            total.seen += s.seen;
            own += a;
          });
      EXPECT_EQ(peers.tasks.size(), 1U);
      EXPECT_EQ(total.escaped, one.escaped);
      EXPECT_EQ(total.seen, one.seen);
      EXPECT_EQ(own.entered, expected.entered);
      EXPECT_EQ(own.paths, expected.paths);
      EXPECT_EQ(own.scatterings, expected.scatterings);
    });
  }
  for (std::thread& t : threads) t.join();
  PathOptions other = options;
  other.seed = 2;
  const PathWorld world{boundary, medium, *source, &camera};
  EXPECT_NE(path_task(world, options), path_task(world, other));
}

}  // namespace
}  // namespace scattermeter
