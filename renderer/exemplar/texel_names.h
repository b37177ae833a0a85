#pragma once

#include <cstddef>
#include <string>

namespace belvedere {

// Names of the bins of AvailableTexels.
std::string distance_name(std::size_t bin);
std::string direction_name(std::size_t bin);
std::string altitude_name(std::size_t bin);

}  // namespace belvedere
