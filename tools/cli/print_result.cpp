#include "tools/cli/print_result.h"

#include "base/text/json.h"
#include "tools/cli/terminal.h"

namespace belvedere::tools {

void print_result(const RunOptions& options, const Json& json, const std::string& text) {
  if (options.json)
    print_out(json.str() + "\n");
  else if (!options.quiet)
    print_out(text);
}

}  // namespace belvedere::tools
