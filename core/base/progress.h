// Progress reports and cancellation of long computations. The libraries print nothing.
#pragma once

#include <exception>
#include <string>

namespace scattermeter {

// Thrown by work that was cancelled; nothing half-done is left behind.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "cancelled"; }
};

// Derive from it to show progress or to cancel; the default does neither. Work consists of
// consecutive stages. All functions but begin() and end() may be called from any thread.
class Progress {
 public:
  virtual ~Progress() = default;
  virtual void begin(const std::string& /*what*/, int /*total_steps*/) {}
  virtual void step() {}
  virtual void end() {}
  // If true, the work throws Cancelled at its next step.
  virtual bool is_cancelled() const { return false; }
};

// One stage of work. A null Progress is allowed.
class ProgressStage {
 public:
  ProgressStage(Progress* progress, const std::string& what, std::size_t total_steps)
      : progress_(progress) {
    if (progress_ == nullptr) return;
    check();
    progress_->begin(what, static_cast<int>(total_steps));
  }
  ~ProgressStage() {
    if (progress_ != nullptr) progress_->end();
  }
  ProgressStage(const ProgressStage&) = delete;
  ProgressStage& operator=(const ProgressStage&) = delete;

  // Throws Cancelled.
  void step() {
    if (progress_ != nullptr) progress_->step();
    check();
  }
  // Throws Cancelled; for work between steps.
  void check() const {
    if (progress_ != nullptr && progress_->is_cancelled()) throw Cancelled();
  }

 private:
  Progress* progress_;
};

}  // namespace scattermeter
