// Blocks of paths on all threads, added up in order.
#pragma once

#include <functional>
#include <memory>

#include "core/path_score.h"
#include "core/path_tracer.h"

namespace scattermeter {

// Calls work(i) for first <= i < end on all threads at once and merge(i, result) one after the
// other, in the order of i. Few results wait at a time.
void run_in_order(int first, int end, const std::function<std::shared_ptr<void>(int)>& work,
                  const std::function<void(int, void*)>& merge);

// Traces blocks first .. end - 1, each into a Tally of its own (a Sink, made by make_tally()), and
// hands them to merge(Tally&, const PathAudit&) in the order of the blocks.
template <class Tally, class Make, class Merge>
void trace_blocks(const PathWorld& world, const PathOptions& options, int first, int end,
                  const Make& make_tally, const Merge& merge) {
  struct Done {
    Tally tally;
    PathAudit audit;
  };
  run_in_order(
      first, end,
      [&](int block) -> std::shared_ptr<void> {
        auto done = std::make_shared<Done>(Done{make_tally(), {}});
        PathTracer<Tally> tracer(world, options, done->tally);
        done->audit = tracer.trace_block(static_cast<std::uint64_t>(block));
        return done;
      },
      [&](int, void* result) {
        auto* done = static_cast<Done*>(result);
        merge(done->tally, done->audit);
      });
}

}  // namespace scattermeter
