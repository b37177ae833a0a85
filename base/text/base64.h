#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace belvedere {

// Bytes as letters and back (RFC 4648, section 4). What is not of that form is nothing.
std::string base64(std::string_view bytes);
std::optional<std::string> base64_bytes(std::string_view text);

}  // namespace belvedere
