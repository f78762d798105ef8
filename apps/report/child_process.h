// Running of another program.
#pragma once

#include <string>
#include <vector>

namespace scattermeter::apps {

struct ChildResult {
  static constexpr int kNotStarted = -1;
  int status = kNotStarted;  // exit status, or 128 + n if signal n terminated it
  std::string errors;        // the first 4 KiB of its stderr, or why it was not started
};

// Runs words[0], searched for in PATH, with the other words as arguments and without a shell. Its
// stdin is `input`, its stdout the open file `output_descriptor`. Waits for its end. A program may
// leave its input unread. Throws std::system_error when no temporary file can be created.
ChildResult run_child(const std::vector<std::string>& words, const std::string& input,
                      int output_descriptor);

}  // namespace scattermeter::apps
