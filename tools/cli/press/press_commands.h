#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace belvedere::tools {

// Commands for printers (docs/press.md); rows of commands.cpp.
std::function<int()> add_palette_check(CLI::App& command);
std::function<int()> add_pdf(CLI::App& command);
std::function<int()> add_proof(CLI::App& command);

}  // namespace belvedere::tools
