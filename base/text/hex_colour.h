#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace belvedere {

// "#rrggbb" of a colour, clamped to 0…1 and rounded to 8 bits.
std::string hex_colour(glm::vec3 colour);
// The colour of such a text; nothing for any other text.
std::optional<glm::vec3> colour_of_hex(std::string_view text);

}  // namespace belvedere
