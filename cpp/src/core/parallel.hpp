// Work on all cores.
#pragma once

#include <cstddef>
#include <functional>

namespace opacity {

// Calls work(0) .. work(count - 1), each once, on as many threads as there are cores; returns when
// all have ended. What one throws first is thrown again here, and what has not begun by then does
// not begin. Parts that write to places of their own give the same result on any number of threads.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace opacity
