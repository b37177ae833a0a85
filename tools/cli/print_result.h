#pragma once

#include <string>

#include "tools/options/run_options.h"

namespace belvedere {
class Json;
}

namespace belvedere::tools {

// What came out, as it was asked for: as JSON, as text or, quiet, not at all.
void print_result(const RunOptions& options, const Json& json, const std::string& text);

}  // namespace belvedere::tools
