#include "core/base/side_by_side.h"

#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/task_arena.h>

namespace scattermeter {

void side_by_side(const std::function<void()>& first, const std::function<void()>& second) {
  tbb::this_task_arena::isolate([&] { tbb::parallel_invoke(first, second); });
}

}  // namespace scattermeter
