#pragma once

#include <cstddef>
#include <string>

namespace belvedere {

// The bins of TexelSupply in words.
std::string distance_name(std::size_t bin);
std::string direction_name(std::size_t bin);
std::string altitude_name(std::size_t bin);

}  // namespace belvedere
