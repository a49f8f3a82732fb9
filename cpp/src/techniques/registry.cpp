#include "techniques/registry.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include "opacity/core/error.hpp"

namespace opacity {
namespace {

struct Registered {
    std::mutex mutex;
    std::vector<RegisteredTechnique> techniques;  // in the order in which they came
    Revision revision = next_revision();
};

Registered& registered() {
    static Registered all;
    return all;
}

template <class Rows>
auto find(Rows&& rows, std::string_view name) {
    return std::find_if(rows.begin(), rows.end(),
                        [&](const auto& row) { return row.name == name; });
}

void check_name(const RegisteredTechnique& technique,
                const std::vector<RegisteredTechnique>& earlier) {
    const std::string& name = technique.name;
    if (!is_word(name))
        throw ParameterError("\"" + name + "\" is no name for a technique",
                             "name it by a-z, 0-9 and _, a letter first");
    const auto fail = [&](const std::string& whose) {
        throw ParameterError(
            "there is already a technique \"" + name + "\", " + whose,
            "choose another name; pyopacity techniques lists those that are taken");
    };
    const auto rows = registry_rows();
    if (find(rows, name) != rows.end()) fail("the engine's own");
    const auto same = find(earlier, name);
    if (same != earlier.end() && !(same->replaceable && technique.replaceable))
        fail(same->replaceable ? "registered by its description" : "registered by a plugin");
}

}  // namespace

bool is_word(std::string_view name) {
    const auto is_lower = [](char c) { return c >= 'a' && c <= 'z'; };
    return !name.empty() && is_lower(name.front()) &&
           std::all_of(name.begin(), name.end(),
                       [&](char c) { return is_lower(c) || (c >= '0' && c <= '9') || c == '_'; });
}

void register_techniques(std::vector<RegisteredTechnique> techniques) {
    Registered& all = registered();
    const std::lock_guard lock{all.mutex};
    std::vector<RegisteredTechnique> next = all.techniques;
    for (RegisteredTechnique& technique : techniques) {
        check_name(technique, next);
        const auto replaced = find(next, technique.name);
        if (replaced != next.end())
            *replaced = std::move(technique);
        else
            next.push_back(std::move(technique));
    }
    all.techniques = std::move(next);
    all.revision = next_revision();
}

std::vector<RegisteredTechnique> registered_techniques() {
    Registered& all = registered();
    const std::lock_guard lock{all.mutex};
    return all.techniques;
}

Revision registered_revision() {
    Registered& all = registered();
    const std::lock_guard lock{all.mutex};
    return all.revision;
}

}  // namespace opacity
