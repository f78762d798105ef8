#include "apps/program/progress_bar.h"

#include <cstdio>

#include <fmt/core.h>

namespace scattermeter::apps {

void ProgressBar::begin(const std::string& what, int total_steps) {
  label_ = what;
  total_ = total_steps;
  done_ = 0;
  draw();
}

void ProgressBar::step() {
  ++done_;
  draw();
}

void ProgressBar::end() {
  if (total_ > 0) fmt::print(stderr, "\r\033[K");
}

void ProgressBar::draw() {
  if (total_ <= 0) return;
  const std::lock_guard lock(mutex_);
  constexpr int kWidth = 30;
  const int filled = kWidth * done_ / total_;
  fmt::print(stderr, "\r{:<22} [{:<{}}] {}/{}", label_,
             std::string(static_cast<std::size_t>(filled), '#'), kWidth, done_.load(), total_);
  std::fflush(stderr);
}

}  // namespace scattermeter::apps
