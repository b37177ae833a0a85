#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace belvedere {

// The number that a text is, with a decimal point whatever the locale. Nothing for other text, also
// around a number, and for numbers that T cannot hold.
template <class T>
std::optional<T> parse_number(std::string_view text) {
  T value{};
  const auto [stop, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace belvedere
