// The processes started together by Open MPI's mpirun.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/transport/path_peers.h"

namespace scattermeter::apps {

// To be constructed once per run of the program. A program that was not started by mpirun, or built
// without Open MPI, is the only rank. All ranks must have processors of the same kind: others may
// give different digits, which gathered() detects.
class Ranks : public PathPeers {
 public:
  // Thrown after another rank has ended, so that this one ends, too.
  class Ended : public std::runtime_error {
   public:
    Ended() : std::runtime_error("another rank has ended") {}
  };

  // Throws InputError if mpirun started several processes of a program built without Open MPI.
  Ranks();
  ~Ranks() override;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int count() const override { return count_; }
  int rank() const override { return rank_; }
  // Throws Ended, and InputError if the ranks do not do the same.
  std::vector<double> gathered(std::uint64_t task, const std::vector<double>& mine) override;

  // The common result of all ranks.
  struct End {
    int status = 0;       // that of the first rank with a status of 2 or more, otherwise of rank 0
    std::string message;  // of that rank, unless it is rank 0
  };
  // To be called once by each rank as its last common action, with its exit status (kFollows after
  // Ended) and its error message. Waits for all ranks.
  static constexpr int kFollows = -1;
  End end(int status, const std::string& message);

 private:
  int count_ = 1;
  int rank_ = 0;
  [[maybe_unused]] bool joined_ = false;
};

}  // namespace scattermeter::apps
