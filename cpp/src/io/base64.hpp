// Bytes as text (RFC 4648), as data URIs hold them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace opacity {

// Nothing where the text holds another letter, or ends within a byte.
std::optional<std::string> base64_decoded(std::string_view text);

}  // namespace opacity
