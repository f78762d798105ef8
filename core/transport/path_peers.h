// Processes that share the tracing of blocks of paths.
#pragma once

#include <cstdint>
#include <vector>

namespace scattermeter {

// Each of them runs the same program on the same input, traces its part of the blocks and adds up
// all blocks in the same order: all obtain the same digits as a single process would.
class PathPeers {
 public:
  virtual ~PathPeers() = default;

  virtual int count() const = 0;  // >= 1
  virtual int rank() const = 0;   // of this process, 0 .. count() - 1

  // The numbers of all, one after the other in the order of their ranks. Waits for the others.
  // Throws if others are at another `task` or have ended.
  virtual std::vector<double> gathered(std::uint64_t task, const std::vector<double>& mine) = 0;
};

}  // namespace scattermeter
