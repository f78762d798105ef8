// A progress bar on the terminal.
#pragma once

#include <atomic>
#include <mutex>
#include <string>

#include "core/base/progress.h"

namespace scattermeter::apps {

// Draws the current stage on stderr and erases it at its end. To be used only if stderr is a
// terminal.
class ProgressBar final : public Progress {
 public:
  void begin(const std::string& what, int total_steps) override;
  void step() override;
  void end() override;

 private:
  void draw();

  std::string label_;
  int total_ = 0;
  std::atomic<int> done_ = 0;
  std::mutex mutex_;
};

}  // namespace scattermeter::apps
