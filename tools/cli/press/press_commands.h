#pragma once

#include <functional>

namespace belvedere::tools {

class CommandOptions;

// Commands for printers (docs/press.md); rows of commands.cpp.
std::function<int()> add_palette_check(CommandOptions& command);
std::function<int()> add_pdf(CommandOptions& command);
std::function<int()> add_proof(CommandOptions& command);

}  // namespace belvedere::tools
