#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace belvedere {

// Bytes as base64 and back (RFC 4648, section 4); nothing for malformed text.
std::string base64(std::string_view bytes);
std::optional<std::string> base64_bytes(std::string_view text);

}  // namespace belvedere
