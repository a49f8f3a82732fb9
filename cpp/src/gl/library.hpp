// A shared library opened at run time. It is never
// closed: drivers leave threads and exit handlers behind.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace opacity::gl {

class Library {
   public:
    // The library that the environment variable names, or else the first
    // of `names` that opens. ContextError with this fix where none does.
    Library(const char* variable, const std::vector<std::string>& names, std::string_view fix);

    // ContextError where the library has no such function: it is not the one that was meant.
    template <class Function>
    void find(Function*& function, const char* name) const {
        function = reinterpret_cast<Function*>(address(name));
    }

   private:
    void* address(const char* name) const;

    void* handle_ = nullptr;
    std::string name_, fix_;
};

}  // namespace opacity::gl
