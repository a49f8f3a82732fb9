// OpenGL drivers run threads and hold locks that do not
// survive a fork: the first call in the child hangs.
#pragma once

namespace opacity::gl {

int process_id() noexcept;

// Called before the first call into a driver. ForkedContextError where a process that this one
// was forked from has already made it, whether or not a context of that time is still alive.
void claim_process();

// ForkedContextError for a context of process `owner`, used in this one.
[[noreturn]] void reject_fork(int owner);

}  // namespace opacity::gl
