// For errors: what somebody who misspelt a name may have meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace opacity {

// The candidate that takes the fewest edits to reach from `name`; empty when there is none.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace opacity
