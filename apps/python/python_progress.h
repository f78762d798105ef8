// Running of long work from Python: without the interpreter's lock, interruptible, with progress.
#pragma once

#include <functional>

#include <pybind11/pybind11.h>

#include "core/base/progress.h"

namespace scattermeter::python {

// Runs `work` on a separate thread and waits for it without the interpreter's lock. Checks for
// signals twenty times a second: Ctrl-C cancels the work and raises KeyboardInterrupt. callback:
// None, or callable(stage: str, done: int, total: int), called on the caller's thread after
// progress; an exception that it raises cancels the work and is raised here. Rethrows what `work`
// throws.
void run_interruptible(const pybind11::object& callback,
                       const std::function<void(Progress&)>& work);

}  // namespace scattermeter::python
