// The program's command line.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/transport/path_peers.h"

namespace scattermeter::apps {

// Runs `scattermeter arguments...` (without the program's name) and returns its exit status: 0
// done, 1 at least one value refused or check failed, 2 bad input or bad usage. Results go to
// `out`, notes and errors to `err`. Peers run the same command line; the first of them writes the
// files. No exceptions leave it except std::bad_alloc and those of `peers`.
int run_command_line(const std::vector<std::string>& arguments, std::ostream& out,
                     std::ostream& err, PathPeers* peers = nullptr);

}  // namespace scattermeter::apps
