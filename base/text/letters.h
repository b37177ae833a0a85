#pragma once

#include <cstddef>
#include <string>

namespace belvedere {

// The letters A to Z small, whatever the locale; all others as they are.
std::string lower_case(std::string text);
// The ending of a file's name in small letters, with its point: ".tif".
std::string lower_ending(const std::string& path);
// A number in groups of three digits: "1 234 567".
std::string grouped(std::size_t number);

}  // namespace belvedere
