#include <csignal>
#include <exception>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <malloc.h>

#include "apps/program/command_line.h"
#include "apps/program/ranks.h"
#include "core/base/input_error.h"

namespace {

using scattermeter::apps::Ranks;

int run(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err,
        Ranks& ranks) {
  try {
    return scattermeter::apps::run_command_line(arguments, out, err, &ranks);
  } catch (const Ranks::Ended&) {
    return Ranks::kFollows;
  } catch (const std::exception& e) {
    err << "scattermeter: internal error: " << e.what() << "\n";
    return 3;
  }
}

}  // namespace

int main(int argc, char** argv) {
  // The memory of one frame serves the next: to return it to the system, and to get it back filled
  // with zeros, takes as long as the decoding.
  constexpr int kLargestThreshold = 32 << 20;
  mallopt(M_MMAP_THRESHOLD, kLargestThreshold);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  // Exceeding the limit of a file's size is then an error of the write, with a message.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    Ranks ranks;
    // Only the first rank prints; an error message of another is printed at the end.
    const bool first = ranks.rank() == 0;
    std::ostream nowhere(nullptr);
    std::ostringstream kept;
    const int status = run(std::vector<std::string>(argv + 1, argv + argc),
                           first ? std::cout : nowhere, first ? std::cerr : kept, ranks);
    const Ranks::End end = ranks.end(status, kept.str());
    if (first) std::cerr << end.message;
    return end.status;
  } catch (const scattermeter::InputError& e) {
    std::cerr << "scattermeter: " << e.what() << "\n";
    return 2;
  }
}
