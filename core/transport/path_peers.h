// Processes that trace the same blocks of paths together.
#pragma once

#include <cstdint>
#include <vector>

namespace scattermeter {

// Each of them runs the same program on the same input, traces its part of the blocks and adds up
// those of all in the same order: all have the same digits, which are those of a single process.
class PathPeers {
 public:
  virtual ~PathPeers() = default;

  virtual int count() const = 0;  // >= 1
  virtual int rank() const = 0;   // of this process, 0 .. count() - 1

  // The numbers of all, one after the other in the order of their ranks. Waits for the others.
  // Throws where they are at another `task` than this one, or at none any more.
  virtual std::vector<double> gathered(std::uint64_t task, const std::vector<double>& mine) = 0;
};

}  // namespace scattermeter
