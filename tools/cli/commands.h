#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace belvedere::tools {

// A subcommand: its options are added to the program, and what it does runs when it was chosen. `run` returns the exit status of a
// command whose answer is a status (diff); 0 otherwise. Errors are thrown.
struct Command {
  CLI::App* options;
  std::function<int()> run;
};
using AddCommand = Command (*)(CLI::App& program);

// One file and one line in commands.cpp a subcommand.
Command add_render(CLI::App& program);
Command add_guidance(CLI::App& program);
Command add_generalize(CLI::App& program);
Command add_synthesize(CLI::App& program);
Command add_check(CLI::App& program);
Command add_deform(CLI::App& program);
Command add_exemplar_check(CLI::App& program);
Command add_exemplar_compare(CLI::App& program);
Command add_info(CLI::App& program);
Command add_diff(CLI::App& program);
Command add_schema(CLI::App& program);
Command add_exemplar_paint(CLI::App& program);
const std::vector<AddCommand>& all_commands();

// The group `exemplar`, which commands about example paintings are added to: `belvedere exemplar check`. Made by the first that asks.
CLI::App& exemplar_commands(CLI::App& program);

}  // namespace belvedere::tools
