// Running another program.
#pragma once

#include <string>
#include <vector>

namespace scattermeter::apps {

struct ChildResult {
  static constexpr int kNotStarted = -1;
  int status = kNotStarted;  // exit status; 128 + n when signal n ended it
  std::string errors;        // what it wrote to stderr, or why it was not started; the first 4 KiB
};

// Runs words[0], looked up in PATH, with the other words as arguments (no shell), `input` on its
// stdin and its stdout in the open file `output_descriptor`; waits for its end. A program that
// leaves its input unread does no harm. Throws std::system_error when no temporary file can be had.
ChildResult run_child(const std::vector<std::string>& words, const std::string& input,
                      int output_descriptor);

}  // namespace scattermeter::apps
