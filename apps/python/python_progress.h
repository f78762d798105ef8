// Long work for Python: without the interpreter's lock, interruptible, with a progress callback.
#pragma once

#include <functional>

#include <pybind11/pybind11.h>

#include "core/base/progress.h"

namespace scattermeter::python {

// Runs `work` on a thread of its own and waits for it without the interpreter's lock. Signals are
// looked at twenty times a second: Ctrl-C cancels the work and raises KeyboardInterrupt.
// callback: None, or callable(stage: str, done: int, total: int), called from the caller's thread
// when there is news; what it raises cancels the work and is raised here. What the work throws is
// thrown here.
void run_interruptible(const pybind11::object& callback,
                       const std::function<void(Progress&)>& work);

}  // namespace scattermeter::python
