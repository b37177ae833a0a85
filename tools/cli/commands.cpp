#include "tools/cli/commands.h"

#include <CLI/CLI.hpp>

namespace belvedere::tools {

const std::vector<AddCommand>& all_commands() {
  static const std::vector<AddCommand> commands = {add_render,         add_guidance, add_generalize,     add_synthesize,
                                                   add_check,          add_deform,   add_exemplar_check, add_exemplar_compare,
                                                   add_exemplar_paint, add_info,     add_diff,           add_schema};
  return commands;
}

CLI::App& exemplar_commands(CLI::App& program) {
  const auto groups = program.get_subcommands([](const CLI::App* command) { return command->get_name() == "exemplar"; });
  if (!groups.empty()) return *groups.front();
  return *program.add_subcommand("exemplar", "About example paintings: what they can serve, and painting one")->require_subcommand(1);
}

}  // namespace belvedere::tools
