#include "apps/python/python_progress.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace py = pybind11;

namespace scattermeter::python {
namespace {

class WatchedProgress final : public Progress {
 public:
  struct News {
    std::string stage;
    int done = 0;
    int total = 0;
  };

  void begin(const std::string& what, int total_steps) override {
    const std::lock_guard lock(mutex_);
    news_ = {what, 0, total_steps};
    is_new_ = true;
  }
  void step() override {
    const std::lock_guard lock(mutex_);
    ++news_.done;
    is_new_ = true;
  }
  bool is_cancelled() const override { return cancelled_; }

  void cancel() { cancelled_ = true; }
  // The progress since the last call.
  std::optional<News> take() {
    const std::lock_guard lock(mutex_);
    if (!is_new_) return std::nullopt;
    is_new_ = false;
    return news_;
  }

 private:
  std::mutex mutex_;
  News news_;
  bool is_new_ = false;
  std::atomic<bool> cancelled_ = false;
};

// Handles pending signals, then calls the callback; requires the interpreter's lock. Returns the
// exception that ends the work, if any.
std::optional<py::error_already_set> look_at_python(const py::object& callback,
                                                    WatchedProgress& progress) {
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    const auto news = progress.take();
    if (news && !callback.is_none()) callback(news->stage, news->done, news->total);
  } catch (py::error_already_set& raised) {
    return std::move(raised);
  }
  return std::nullopt;
}

}  // namespace

void run_interruptible(const py::object& callback, const std::function<void(Progress&)>& work) {
  constexpr auto kLookEvery = std::chrono::milliseconds(50);
  WatchedProgress progress;
  std::exception_ptr thrown;
  std::optional<py::error_already_set> raised;
  {
    const py::gil_scoped_release without_lock;
    std::mutex mutex;
    std::condition_variable ended;
    bool done = false;
    std::thread worker([&] {
      try {
        work(progress);
      } catch (...) {
        thrown = std::current_exception();
      }
      const std::lock_guard lock(mutex);
      done = true;
      ended.notify_all();
    });
    std::unique_lock lock(mutex);
    while (!ended.wait_for(lock, kLookEvery, [&] { return done; })) {
      if (raised) continue;
      lock.unlock();
      {
        const py::gil_scoped_acquire with_lock;
        raised = look_at_python(callback, progress);
      }
      if (raised) progress.cancel();
      lock.lock();
    }
    lock.unlock();
    worker.join();
  }
  if (raised) throw std::move(*raised);
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace scattermeter::python
