#include "tools/options/run_options.h"

#include "tools/options/options.h"

namespace belvedere::tools {

void add_run_options(CommandOptions& command, RunOptions& options, const std::string& unchanged) {
  command
      .add_option("--threads", options.threads,
                  "Processor threads; 0, the default, takes all. Changes no " + unchanged)
      .type_name("N")
      .range(0, 4096);
  command.add_flag("--quiet,-q", options.quiet, "No progress, no notes");
  command.add_flag("--json", options.json, "The result as JSON on standard output");
}

}  // namespace belvedere::tools
