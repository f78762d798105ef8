// A progress line for long work.
#pragma once

#include <atomic>
#include <mutex>
#include <string>

namespace scattermeter::apps {

// Draws on stderr while it lives, only when stderr is a terminal and `quiet` is off; leaves nothing
// behind. step() may be called from any thread.
class Progress {
 public:
  Progress(std::string label, int total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void step();

 private:
  void draw();
  std::string label_;
  int total_;
  bool shown_;
  std::atomic<int> done_ = 0;
  std::mutex mutex_;
};

}  // namespace scattermeter::apps
