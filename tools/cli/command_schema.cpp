#include <memory>

#include "renderer/scene/scene_file.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {

Action add_schema(CommandOptions& command) {
  const auto markdown = std::make_shared<bool>(false);
  command.add_flag("--markdown", *markdown,
                   "Prints a reference in Markdown instead of a JSON Schema (draft 4)");
  command.footer(
      "  belvedere schema > scene.schema.json     for editors that complete keys and check values\n"
      "  belvedere schema --markdown | less");
  return [markdown] {
    print_out(*markdown ? scene_reference() : scene_json_schema());
    return 0;
  };
}

}  // namespace belvedere::tools
