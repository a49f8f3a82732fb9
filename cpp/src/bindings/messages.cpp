#include "bindings/messages.hpp"

#include "bindings/bindings.hpp"

namespace opacity::bindings {
namespace {

const char* level_name(LogLevel level) {
    switch (level) {
        case LogLevel::debug:
            return "debug";
        case LogLevel::info:
            return "info";
        case LogLevel::warning:
            return "warning";
        default:
            return "error";
    }
}

}  // namespace

void Messages::add(LogLevel level, std::string_view message) noexcept try {
    const std::lock_guard held{mutex_};
    if (list_.size() < most_) list_.emplace_back(level, message);
} catch (...) {
    // Without memory for a message there is none.
}

py::list Messages::take() {
    decltype(list_) taken;
    {
        const std::lock_guard held{mutex_};
        taken.swap(list_);
    }
    py::list list;
    for (const auto& [level, message] : taken)
        list.append(py::make_tuple(level_name(level), text(message)));
    return list;
}

}  // namespace opacity::bindings
