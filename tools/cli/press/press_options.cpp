#include "tools/cli/press/press_options.h"

#include <CLI/CLI.hpp>

namespace belvedere::tools {

void add_press_options(CLI::App& command, PressOptions& options, bool conversion) {
  command.add_option("--profile", options.profile, "ICC profile of the printing press, CMYK")->required()->type_name("FILE");
  if (!conversion) return;
  command.add_option("--intent", options.intent, "How colours that the press does not have are brought into those that it has")
      ->check(CLI::IsMember(rendering_intent_names()))
      ->capture_default_str();
  command.add_flag("--no-black-point", options.no_black_point,
                   "Leaves the picture's black where it is, even where the press has none so dark");
}

}  // namespace belvedere::tools
