#pragma once

#include <string>
#include <vector>

#include "tools/options/program_description.h"

namespace belvedere::tools {

// "bash", "fish", "zsh".
std::vector<std::string> completed_shells();

// A script that makes the shell complete commands, options, their values, scene files and folders.
// The completion script for a shell; self-contained, it does not run the program. Error(usage) for
// an unknown shell.
std::string shell_completion(const CommandDescription& program, const std::string& shell);

}  // namespace belvedere::tools
