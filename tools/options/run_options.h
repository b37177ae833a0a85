#pragma once

#include <string>

namespace belvedere::tools {

class CommandOptions;

// Run settings that most commands share.
struct RunOptions {
  int threads = 0;  // 0: all
  bool quiet = false;
  bool json = false;
};
// --threads, --quiet and --json. `unchanged`: what the number of threads does not change, "pixel".
void add_run_options(CommandOptions& command, RunOptions& options,
                     const std::string& unchanged = "pixel");

}  // namespace belvedere::tools
