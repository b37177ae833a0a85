#pragma once

#include <cstddef>
#include <string>

namespace belvedere {

// ASCII letters A to Z in lower case, independent of the locale; other bytes unchanged.
std::string lower_case(std::string text);
// The extension of a file's name in lower case, with its point: ".tif".
std::string lower_extension(const std::string& path);
// A number in groups of three digits: "1 234 567".
std::string grouped(std::size_t number);

}  // namespace belvedere
