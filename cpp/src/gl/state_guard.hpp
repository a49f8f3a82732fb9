// The OpenGL state that the library touches: set to known values on
// entry to an adopted context, and put back for its owner at the end.
#pragma once

#include <memory>

struct GladGLContext;

namespace opacity::gl {

// What every pass may rely on: nothing enabled but multisampling,
// everything written, rows of pixels without padding.
void set_default_state(const GladGLContext& gl);

// Saves, then sets the defaults. Texture units 0..31, storage buffers
// 0..15 and images 0..7 are covered; the library uses no others.
class StateGuard {
   public:
    explicit StateGuard(const GladGLContext& gl);
    ~StateGuard();
    StateGuard(const StateGuard&) = delete;
    StateGuard& operator=(const StateGuard&) = delete;

   private:
    struct Saved;
    const GladGLContext& gl_;
    std::unique_ptr<Saved> saved_;
};

}  // namespace opacity::gl
