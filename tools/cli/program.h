#pragma once

#include <string>
#include <vector>

#include "tools/options/program_description.h"

namespace belvedere::tools {

// Does what a command line says; `arguments` without the program's name. Returns the exit status: 0, or that of a command whose answer is
// one. Throws Error(usage) for a command line that cannot be meant, naming the nearest command to a misspelt one.
int run_program(const std::vector<std::string>& arguments);

// All commands and their options.
CommandDescription describe_program();

}  // namespace belvedere::tools
