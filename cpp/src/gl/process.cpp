#include "gl/process.hpp"

#include <unistd.h>

#include <atomic>
#include <string>

#include "opacity/core/error.hpp"

namespace opacity::gl {

int process_id() noexcept {
    return int(getpid());
}

void claim_process() {
    // The one piece of process-wide state: the driver's
    // threads are process-wide too, and outlive every Context.
    static std::atomic<int> claimed_by{0};
    int nobody = 0;
    if (!claimed_by.compare_exchange_strong(nobody, process_id()) && nobody != process_id()) {
        reject_fork(nobody);
    }
}

void reject_fork(int owner) {
    throw ForkedContextError(
        "OpenGL was started in process " + std::to_string(owner) + ", and process " +
            std::to_string(process_id()) + " was forked from it; drivers do not survive a fork",
        "use the spawn start method (multiprocessing.get_context(\"spawn\")), or "
        "fork before the first context is made");
}

}  // namespace opacity::gl
