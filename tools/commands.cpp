#include "tools/commands.h"

namespace belvedere::tools {

const std::vector<AddCommand>& all_commands() {
  static const std::vector<AddCommand> commands = {add_render, add_guidance, add_generalize, add_synthesize, add_check,
                                                   add_deform, add_info,     add_diff,       add_schema};
  return commands;
}

}  // namespace belvedere::tools
