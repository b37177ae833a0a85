#pragma once

#include <string>

#include "tools/options/program_description.h"

namespace belvedere::tools {

// The manual page of all commands, in roff with the man macros; ASCII, other characters as
// \[uXXXX]. version: "belvedere 0.3.0".
std::string man_page(const CommandDescription& program, const std::string& version);

}  // namespace belvedere::tools
