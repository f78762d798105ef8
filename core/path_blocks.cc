#include "core/path_blocks.h"

#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

namespace scattermeter {

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

}  // namespace scattermeter
