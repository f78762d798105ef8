// The processes that Open MPI's mpirun starts together.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/transport/path_peers.h"

namespace scattermeter::apps {

// One for the whole run of the program. A program that mpirun did not start, and one that is built
// without Open MPI, is alone. All ranks must have processors of one kind: another's vectors may
// give other digits, which gathered() notices.
class Ranks : public PathPeers {
 public:
  // Another rank has come to its end; this one follows it.
  class Ended : public std::runtime_error {
   public:
    Ended() : std::runtime_error("another rank has ended") {}
  };

  // Throws InputError where mpirun started several of a program that knows nothing of it.
  Ranks();
  ~Ranks() override;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int count() const override { return count_; }
  int place() const override { return place_; }
  // Throws Ended, and InputError where the ranks do not do the same.
  std::vector<double> gathered(std::uint64_t task, const std::vector<double>& mine) override;

  // How all of them came to an end.
  struct End {
    int status = 0;       // the first rank's, of those with 2 and more; else rank 0's
    std::string message;  // of that rank, where it is not rank 0
  };
  // Waits for all, who call it once each, the last thing they do together: its exit status
  // (kFollows after Ended) and what it has to say of an error.
  static constexpr int kFollows = -1;
  End end(int status, const std::string& message);

 private:
  int count_ = 1;
  int place_ = 0;
  [[maybe_unused]] bool joined_ = false;
};

}  // namespace scattermeter::apps
