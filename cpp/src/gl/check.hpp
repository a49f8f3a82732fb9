// OpenGL's error codes as exceptions.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "opacity/gl/context.hpp"

namespace opacity::gl {

// Throws for the errors since the last look: OutOfMemoryError, DeviceLostError, or an Error
// that asks for a bug report. `doing` completes "OpenGL ran out of memory while ...".
void check_errors(const Context& context, std::string_view doing);

// Throws OutOfMemoryError for what is more than the device has, where a driver does not: NVIDIA's
// allocates when a texture is first written.
void check_fits(const Context& context, std::size_t bytes, std::string_view doing);

// "1.5 GiB"
std::string size_text(std::size_t bytes);

}  // namespace opacity::gl
