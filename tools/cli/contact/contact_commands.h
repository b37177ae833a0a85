#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace belvedere::tools {

// Commands whose result is one sheet of several pictures of a scene; rows of commands.cpp.
std::function<int()> add_figure(CLI::App& command);
std::function<int()> add_sweep(CLI::App& command);

}  // namespace belvedere::tools
