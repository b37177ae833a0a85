#pragma once

#include <functional>

namespace belvedere::tools {

class CommandOptions;

// Commands whose result is one sheet of several pictures of a scene; rows of commands.cpp.
std::function<int()> add_figure(CommandOptions& command);
std::function<int()> add_sweep(CommandOptions& command);

}  // namespace belvedere::tools
