// What a frame did, and why; and what it holds.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace opacity {

struct PassReport {
    enum class Status { ran, cached, culled };
    std::string name;
    Status status = Status::culled;
    std::string why = {};  // the reads that moved, or what made the pass unnecessary
    double ms = 0.0;
    std::string note = {};  // what the pass found when it ran last, such as the split ratio
    std::size_t calls = 0;  // draw calls and dispatches of this frame; without OpenGL none
};

// A texture or buffer that the last frame needed.
struct ResourceMemory {
    std::string name;
    std::size_t bytes = 0;   // stored_bytes, or those of the buffer
    std::size_t texels = 0;  // of one layer; of a buffer 0
};

using Report = std::vector<PassReport>;

const char* to_string(PassReport::Status status);
// A table for people.
std::string to_string(const Report& report);

}  // namespace opacity
