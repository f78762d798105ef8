// Two pieces of work at the same time.
#pragma once

#include <functional>

namespace scattermeter {

// Returns when both have ended; rethrows what one of them throws. A thread that waits for the other
// does not start unrelated work, of which each piece would hold its own memory.
void side_by_side(const std::function<void()>& first, const std::function<void()>& second);

}  // namespace scattermeter
