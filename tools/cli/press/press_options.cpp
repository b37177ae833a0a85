#include "tools/cli/press/press_options.h"
#include "tools/options/options.h"

namespace belvedere::tools {

void add_press_options(CommandOptions& command, PressOptions& options, bool conversion) {
  command.add_option("--profile", options.profile, "ICC profile of the printing press, CMYK").required().type_name("FILE");
  if (!conversion) return;
  command.add_option("--intent", options.intent, "How colours that the press does not have are brought into those that it has")
      .one_of(rendering_intent_names())
      .show_default();
  command.add_flag("--no-black-point", options.no_black_point,
                   "Leaves the picture's black where it is, even where the press has none so dark");
}

}  // namespace belvedere::tools
