#include "gl/library.hpp"

#include <dlfcn.h>

#include <cstdlib>

#include "opacity/core/error.hpp"

namespace opacity::gl {

Library::Library(const char* variable, const std::vector<std::string>& names, std::string_view fix)
    : fix_{fix} {
    const char* chosen = std::getenv(variable);
    std::string tried;
    for (const std::string& name : chosen&&* chosen ? std::vector<std::string>{chosen} : names) {
        handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
        name_ = name;
        if (handle_) return;
        const char* reason = dlerror();  // starts with the library's name
        tried += std::string{"\n  "} + (reason ? reason : name.c_str());
    }
    throw ContextError("no OpenGL context: a library did not open" + tried, fix_);
}

void* Library::address(const char* name) const {
    if (void* found = dlsym(handle_, name)) return found;
    throw ContextError("no OpenGL context: " + name_ + " has no function " + name, fix_);
}

}  // namespace opacity::gl
