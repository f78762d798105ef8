// Parallel tracing of blocks of paths, added up in order.
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/transport/path_peers.h"
#include "core/transport/path_score.h"
#include "core/transport/path_tracer.h"

namespace scattermeter {

// Calls work(i) for first <= i < end on all threads at once and merge(i, result) one after the
// other, in the order of i. Only a few results are held at a time.
void run_in_order(int first, int end, const std::function<std::shared_ptr<void>(int)>& work,
                  const std::function<void(int, void*)>& merge);

// Calls work(i), which appends to a vector, for first <= i < end, each with one of the peers, and
// merge(i, numbers) one after the other, in the order of i, with all of them. Every call appends
// the same number. `task` detects peers that work on something else.
void share_in_order(PathPeers& peers, std::uint64_t task, int first, int end,
                    const std::function<void(int, std::vector<double>&)>& work,
                    const std::function<void(int, const double*)>& merge);

// An identifier of the paths: equal for the same paths, whatever the blocks.
std::uint64_t path_task(const PathWorld& world, const PathOptions& options);

// A tally that peers can send each other: numbers(f) calls f(double&) for all its numbers, in the
// same order for every tally from make_tally().
template <class Tally>
concept SentTally = requires(Tally& tally) {
  tally.numbers([](double&) {});
};

// Traces blocks first .. end - 1, each into a Tally of its own (a Sink, made by make_tally()), and
// hands them to merge(Tally&, const PathAudit&) in the order of the blocks. Peers share the blocks
// of a SentTally and trace all blocks of any other.
template <class Tally, class Make, class Merge>
void trace_blocks(const PathWorld& world, const PathOptions& options, int first, int end,
                  const Make& make_tally, const Merge& merge) {
  struct Done {
    Tally tally;
    PathAudit audit;
  };
  if constexpr (SentTally<Tally>) {
    if (options.peers != nullptr && options.peers->count() > 1) {
      share_in_order(
          *options.peers, path_task(world, options), first, end,
          [&](int block, std::vector<double>& numbers) {
            Tally tally = make_tally();
            PathTracer<Tally> tracer(world, options, tally);
            PathAudit audit = tracer.trace_block(static_cast<std::uint64_t>(block));
            tally.numbers([&](double& number) { numbers.push_back(number); });
            audit.numbers([&](auto& number) { numbers.push_back(static_cast<double>(number)); });
          },
          [&](int, const double* numbers) {
            Done done{make_tally(), {}};
            done.tally.numbers([&](double& number) { number = *numbers++; });
            done.audit.numbers([&]<class T>(T& number) { number = static_cast<T>(*numbers++); });
            merge(done.tally, done.audit);
          });
      return;
    }
  }
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
