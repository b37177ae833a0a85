#include "base/text/hex_colour.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace belvedere {

std::string hex_colour(glm::vec3 colour) {
  const auto byte = [](float value) { return std::lround(255.F * std::clamp(value, 0.F, 1.F)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.x), byte(colour.y), byte(colour.z));
}

std::optional<glm::vec3> colour_of_hex(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  std::uint32_t rgb = 0;
  const auto [end, fault] = std::from_chars(text.data() + 1, text.data() + 7, rgb, 16);
  if (fault != std::errc() || end != text.data() + 7) return std::nullopt;
  return glm::vec3(rgb >> 16U, rgb >> 8U & 255U, rgb & 255U) / 255.F;
}

}  // namespace belvedere
