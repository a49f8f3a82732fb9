// Work on all cores, watched by the thread that asked for it.
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

namespace opacity::rays {

// Does work(0) .. work(count - 1), each once, on up to `threads` threads (0: one a core). The
// calling thread meanwhile calls watch(fraction done) some twenty times a second. What either
// throws stops the work, and is thrown here once no thread is left.
void in_parallel(std::size_t count, int threads,
                 const std::function<void(std::size_t, std::stop_token)>& work,
                 const std::function<void(double)>& watch);

}  // namespace opacity::rays
