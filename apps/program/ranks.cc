#include "apps/program/ranks.h"

#include <algorithm>
#include <climits>
#include <cstdlib>

#ifdef SCATTERMETER_MPI
#include <mpi.h>
#endif

#include "core/base/input_error.h"

namespace scattermeter::apps {

#ifdef SCATTERMETER_MPI

namespace {

// What each rank tells before numbers are sent: where it is, and how many it has.
struct Place {
  enum : std::uint64_t { kAtWork, kAtEnd };
  std::uint64_t at = kAtWork;
  std::uint64_t task = 0;
  std::uint64_t size = 0;
};

constexpr char kApart[] =
    "mpirun: the ranks do not do the same: their input differs, or their processors are of several "
    "kinds";

std::vector<Place> places(const Place& mine, int count) {
  std::vector<Place> all(static_cast<std::size_t>(count));
  MPI_Allgather(&mine, 3, MPI_UINT64_T, all.data(), 3, MPI_UINT64_T, MPI_COMM_WORLD);
  return all;
}

bool started_by_a_launcher() {
  return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMIX_RANK") != nullptr ||
         std::getenv("PMI_RANK") != nullptr;
}

}  // namespace

Ranks::Ranks() {
  // Alone, MPI_Init takes longer than some commands, and needs more of the machine than they do.
  if (!started_by_a_launcher()) return;
  int level = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  MPI_Comm_rank(MPI_COMM_WORLD, &place_);
  joined_ = true;
}

Ranks::~Ranks() {
  if (joined_) MPI_Finalize();
}

std::vector<double> Ranks::gathered(std::uint64_t task, const std::vector<double>& mine) {
  if (count_ == 1) return mine;
  const std::vector<Place> all = places({Place::kAtWork, task, mine.size()}, count_);
  std::vector<int> sizes;
  std::vector<int> begins;
  std::uint64_t total = 0;
  for (const Place& p : all) {
    if (p.at == Place::kAtEnd) throw Ended();
  }
  for (const Place& p : all) {
    if (p.task != task) {
      throw InputError(std::string(kApart));
    }
    sizes.push_back(static_cast<int>(p.size));
    begins.push_back(static_cast<int>(total));
    total += p.size;
  }
  if (total > INT_MAX) {
    throw InputError("mpirun", std::to_string(total) + " numbers at once are more than MPI counts");
  }
  std::vector<double> out(total);
  MPI_Allgatherv(mine.data(), static_cast<int>(mine.size()), MPI_DOUBLE, out.data(), sizes.data(),
                 begins.data(), MPI_DOUBLE, MPI_COMM_WORLD);
  return out;
}

Ranks::End Ranks::end(int status, const std::string& message) {
  if (count_ == 1) return {status, {}};
  // Those at work follow (Ended) and come here.
  const auto at_end = [](const Place& p) { return p.at == Place::kAtEnd; };
  for (;;) {
    const std::vector<Place> all = places({Place::kAtEnd, 0, 0}, count_);
    if (std::all_of(all.begin(), all.end(), at_end)) break;
  }
  std::vector<int> statuses(static_cast<std::size_t>(count_));
  MPI_Allgather(&status, 1, MPI_INT, statuses.data(), 1, MPI_INT, MPI_COMM_WORLD);
  const auto failed = std::find_if(statuses.begin(), statuses.end(), [](int s) { return s >= 2; });
  if (failed == statuses.end()) {
    // Another one had less to do.
    if (statuses.front() == kFollows) return {2, std::string("scattermeter: ") + kApart + "\n"};
    return {statuses.front(), {}};
  }
  const int who = static_cast<int>(failed - statuses.begin());
  std::string told = message;
  int length = static_cast<int>(told.size());
  MPI_Bcast(&length, 1, MPI_INT, who, MPI_COMM_WORLD);
  told.resize(static_cast<std::size_t>(length));
  MPI_Bcast(told.data(), length, MPI_CHAR, who, MPI_COMM_WORLD);
  return {*failed, who == 0 ? std::string() : told};
}

#else

Ranks::Ranks() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (size != nullptr && std::atoi(size) > 1) {
    throw InputError("mpirun",
                     "this program is built without Open MPI (CMake: "
                     "-DSCATTERMETER_MPI=ON); it runs as one process");
  }
}

Ranks::~Ranks() = default;

std::vector<double> Ranks::gathered(std::uint64_t, const std::vector<double>& mine) { return mine; }

Ranks::End Ranks::end(int status, const std::string&) { return {status, {}}; }

#endif

}  // namespace scattermeter::apps
