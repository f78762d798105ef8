#include "apps/progress.h"

#include <cstdio>
#include <utility>

#include <fmt/core.h>
#include <unistd.h>

namespace scattermeter::apps {

Progress::Progress(std::string label, int total, bool quiet)
    : label_(std::move(label)), total_(total), shown_(!quiet && total > 0 && isatty(2) != 0) {
  draw();
}

Progress::~Progress() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

void Progress::step() {
  ++done_;
  draw();
}

void Progress::draw() {
  if (!shown_) return;
  const std::lock_guard lock(mutex_);
  constexpr int kWidth = 30;
  const int filled = kWidth * done_ / total_;
  fmt::print(stderr, "\r{:<22} [{:<{}}] {}/{}", label_,
             std::string(static_cast<std::size_t>(filled), '#'), kWidth, done_.load(), total_);
  std::fflush(stderr);
}

}  // namespace scattermeter::apps
