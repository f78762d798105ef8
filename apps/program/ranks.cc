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

// Sent by each rank before its numbers: whether it is working, on what, and how many they are.
struct Announcement {
  enum : std::uint64_t { kAtWork, kAtEnd };
  std::uint64_t at = kAtWork;
  std::uint64_t task = 0;
  std::uint64_t size = 0;
};

constexpr char kApart[] =
    "mpirun: the ranks do not do the same: their input differs, or their processors are of "
    "different "
    "kinds";

std::vector<Announcement> announcements(const Announcement& mine, int count) {
  std::vector<Announcement> all(static_cast<std::size_t>(count));
  MPI_Allgather(&mine, 3, MPI_UINT64_T, all.data(), 3, MPI_UINT64_T, MPI_COMM_WORLD);
  return all;
}

bool started_by_a_launcher() {
  return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMIX_RANK") != nullptr ||
         std::getenv("PMI_RANK") != nullptr;
}

}  // namespace

Ranks::Ranks() {
  // For a single process MPI_Init would take longer than some commands.
  if (!started_by_a_launcher()) return;
  int level = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  joined_ = true;
}

Ranks::~Ranks() {
  if (joined_) MPI_Finalize();
}

std::vector<double> Ranks::gathered(std::uint64_t task, const std::vector<double>& mine) {
  if (count_ == 1) return mine;
  const std::vector<Announcement> all =
      announcements({Announcement::kAtWork, task, mine.size()}, count_);
  std::vector<int> sizes;
  std::vector<int> begins;
  std::uint64_t total = 0;
  for (const Announcement& p : all) {
    if (p.at == Announcement::kAtEnd) throw Ended();
  }
  for (const Announcement& p : all) {
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
  // Ranks that are still working receive Ended and then come here.
  const auto at_end = [](const Announcement& p) { return p.at == Announcement::kAtEnd; };
  for (;;) {
    const std::vector<Announcement> all = announcements({Announcement::kAtEnd, 0, 0}, count_);
    if (std::all_of(all.begin(), all.end(), at_end)) break;
  }
  std::vector<int> statuses(static_cast<std::size_t>(count_));
  MPI_Allgather(&status, 1, MPI_INT, statuses.data(), 1, MPI_INT, MPI_COMM_WORLD);
  const auto failed = std::find_if(statuses.begin(), statuses.end(), [](int s) { return s >= 2; });
  if (failed == statuses.end()) {
    // Another rank had less to do.
    if (statuses.front() == kFollows) return {2, std::string("scattermeter: ") + kApart + "\n"};
    return {statuses.front(), {}};
  }
  const int who = static_cast<int>(failed - statuses.begin());
  std::string first_message = message;
  int length = static_cast<int>(first_message.size());
  MPI_Bcast(&length, 1, MPI_INT, who, MPI_COMM_WORLD);
  first_message.resize(static_cast<std::size_t>(length));
  MPI_Bcast(first_message.data(), length, MPI_CHAR, who, MPI_COMM_WORLD);
  return {*failed, who == 0 ? std::string() : first_message};
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
