#include "renderer/image/provenance.h"
#include "tools/cli/commands.h"
#include "tools/cli/man_page.h"
#include "tools/cli/program.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {

Action add_man(CommandOptions& command) {
  command.footer(
      "An installed program provides it as: man belvedere\n"
      "\n"
      "  belvedere man | man -l -");
  return [] {
    print_out(man_page(describe_program(), "belvedere " + program_version()));
    return 0;
  };
}

}  // namespace belvedere::tools
