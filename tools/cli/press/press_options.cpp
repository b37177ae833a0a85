#include "tools/cli/press/press_options.h"
#include "tools/options/options.h"

namespace belvedere::tools {

void add_press_options(CommandOptions& command, PressOptions& options, bool conversion) {
  command.add_option("--profile", options.profile, "ICC profile of the printing press, CMYK")
      .required()
      .type_name("FILE")
      .files(FileUse::input);
  if (!conversion) return;
  command
      .add_option("--intent", options.intent,
                  "Rendering intent for colours that the press cannot print")
      .one_of(rendering_intent_names())
      .show_default();
  command.add_flag("--no-black-point", options.no_black_point,
                   "Keeps the picture's black, even where the press has none as dark");
}

}  // namespace belvedere::tools
