// Work on all cores.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <stop_token>

namespace opacity {

// Does work(0) .. work(count - 1), each once, on up to `threads` threads; 0: OPACITY_THREADS of the
// environment, or one a core. The calling thread meanwhile calls watch(fraction done) some twenty
// times a second. What either throws stops the work, and is thrown here once no thread is left.
void in_parallel(std::size_t count, int threads,
                 const std::function<void(std::size_t, const std::stop_token&)>& work,
                 const std::function<void(double)>& watch);

// Unwatched, on all cores. Parts that write to places of their own give the same result on any
// number of threads.
inline void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work) {
    if (count == 1) return work(0);
    in_parallel(
        count, 0, [&](std::size_t i, const std::stop_token&) { work(i); }, [](double) {});
}

// In parts of neighbours, where each alone is too little for a thread: work(begin, end).
template <class Work>
void parallel_parts(std::size_t count, std::size_t at_once, const Work& work) {
    parallel_for((count + at_once - 1) / at_once, [&](std::size_t part) {
        work(part * at_once, std::min(count, (part + 1) * at_once));
    });
}

}  // namespace opacity
