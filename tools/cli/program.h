#pragma once

#include <string>
#include <vector>

#include "tools/options/program_description.h"

namespace belvedere::tools {

// Executes a command line; `arguments` without the program's name. Returns the exit status: 0, or
// that of a command whose result is one. Throws Error(usage) for an invalid command line, naming
// the nearest command to a misspelt one.
int run_program(const std::vector<std::string>& arguments);

// The body of main(), callable from tests: prepares the process, executes the command line, and
// turns every error into a message on stderr and the exit status of its kind. The one place that
// catches errors.
int program_main(int argc, char** argv);

// All commands and their options.
CommandDescription describe_program();

}  // namespace belvedere::tools
