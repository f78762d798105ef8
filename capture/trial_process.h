// Doing something first in a process of its own, to see whether it comes back.
#pragma once

#include <functional>

namespace scattermeter::capture {

// Runs `work` in a copy of this process that shares nothing with it, prints nothing and leaves no
// core file, and waits for its end. True when `work` returned; false when it threw, crashed or took
// longer than limit_s of wall time (>= 1). Only the calling thread lives on in the copy: `work`
// must not use other threads. Throws std::system_error when there can be no other process.
bool comes_back(const std::function<void()>& work, unsigned limit_s);

}  // namespace scattermeter::capture
