// Every failure that a user can cause: what was wrong, and how to fix it. An error without a fix
// does not compile.
#pragma once

#include <exception>
#include <string>
#include <utility>

namespace opacity {

class Error : public std::exception {
   public:
    Error(std::string problem, std::string fix)
        : problem_{std::move(problem)},
          fix_{std::move(fix)},
          message_{problem_ + "\n  fix: " + fix_} {}

    const char* what() const noexcept override { return message_.c_str(); }
    const std::string& problem() const noexcept { return problem_; }
    const std::string& fix() const noexcept { return fix_; }

   private:
    std::string problem_, fix_, message_;
};

// A value, a name or an array that the call cannot take.
struct ParameterError : Error {
    using Error::Error;
};
// A file that is truncated, inconsistent, or not what its name says.
struct FileFormatError : Error {
    using Error::Error;
};
// No OpenGL context, or one used from the wrong thread.
struct ContextError : Error {
    using Error::Error;
};
// A context used after a fork: only a spawned process may render.
struct ForkedContextError : ContextError {
    using ContextError::ContextError;
};
// The driver reset the device; everything on it is gone.
struct DeviceLostError : ContextError {
    using ContextError::ContextError;
};
// A shader that does not compile or link, or reads what its pass did not declare.
struct ShaderError : Error {
    using Error::Error;
};
// The driver or the machine has no memory left for what was asked.
struct OutOfMemoryError : Error {
    using Error::Error;
};

}  // namespace opacity
