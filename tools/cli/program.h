#pragma once

#include <string>
#include <vector>

#include "tools/options/program_description.h"

namespace belvedere::tools {

// Does what a command line says; `arguments` without the program's name. Returns the exit status: 0, or that of a command whose answer is
// one. Throws Error(usage) for a command line that cannot be meant, naming the nearest command to a misspelt one.
int run_program(const std::vector<std::string>& arguments);

// What main() does, so that tests can call it: prepares the process, does what the command line says, and turns every error into a message
// on stderr and the exit status of its kind. The one place that catches errors.
int program_main(int argc, char** argv);

// All commands and their options.
CommandDescription describe_program();

}  // namespace belvedere::tools
