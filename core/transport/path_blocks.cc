#include "core/transport/path_blocks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <stdexcept>
#include <string>

#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

namespace scattermeter {
namespace {

// Peers hold the numbers of so many blocks at a time.
constexpr int kBlocksAtATime = 64;

}  // namespace

void run_in_order(int first, int end, const std::function<std::shared_ptr<void>(int)>& work,
                  const std::function<void(int, void*)>& merge) {
  struct Item {
    int block;
    std::shared_ptr<void> result;
  };
  int next = first;
  const auto tokens = static_cast<std::size_t>(2 * tbb::this_task_arena::max_concurrency());
  tbb::parallel_pipeline(tokens, tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order,
                                                             [&](tbb::flow_control& control) {
                                                               if (next >= end) control.stop();
                                                               return next++;
                                                             }) &
                                     tbb::make_filter<int, Item>(tbb::filter_mode::parallel,
                                                                 [&](int block) {
                                                                   return Item{block, work(block)};
                                                                 }) &
                                     tbb::make_filter<Item, void>(
                                         tbb::filter_mode::serial_in_order, [&](const Item& item) {
                                           merge(item.block, item.result.get());
                                         }));
}

void share_in_order(PathPeers& peers, std::uint64_t task, int first, int end,
                    const std::function<void(int, std::vector<double>&)>& work,
                    const std::function<void(int, const double*)>& merge) {
  for (int begin = first; begin < end; begin += kBlocksAtATime) {
    const int n = std::min(kBlocksAtATime, end - begin);
    const auto from = [&](int rank) { return begin + n * rank / peers.count(); };
    std::vector<double> mine;
    run_in_order(
        from(peers.rank()), from(peers.rank() + 1),
        [&](int block) {
          auto numbers = std::make_shared<std::vector<double>>();
          work(block, *numbers);
          return numbers;
        },
        [&](int, void* result) {
          const auto& numbers = *static_cast<const std::vector<double>*>(result);
          mine.insert(mine.end(), numbers.begin(), numbers.end());
        });
    const std::vector<double> all = peers.gathered(task ^ static_cast<std::uint64_t>(begin), mine);
    const std::size_t each = all.size() / static_cast<std::size_t>(n);
    if (each * static_cast<std::size_t>(n) != all.size()) {
      throw std::invalid_argument("share_in_order: " + std::to_string(all.size()) + " numbers of " +
                                  std::to_string(n) + " blocks");
    }
    for (int i = 0; i < n; ++i) merge(begin + i, &all[each * static_cast<std::size_t>(i)]);
  }
}

std::uint64_t path_task(const PathWorld& world, const PathOptions& options) {
  std::uint64_t hash = options.seed;
  const std::array<double, 4> phase = world.medium.phase.numbers();
  for (const double number :
       {world.medium.sigma_s_per_mm, world.medium.sigma_a_per_mm, phase[0], phase[1], phase[2],
        phase[3], world.medium.eta_int_over_ext, world.medium.surface_alpha,
        static_cast<double>(options.paths_per_block)}) {
    // Boost's hash_combine for 64 bits.
    hash ^=
        std::bit_cast<std::uint64_t>(number) + 0x9e3779b97f4a7c15U + (hash << 12U) + (hash >> 4U);
  }
  return hash;
}

}  // namespace scattermeter
