#pragma once

#include "tools/cli/new/new_options.h"

namespace belvedere::tools {

// Writes a scene of a region with the best view, or the one that is chosen: `belvedere new`.
int make_new_scene(const NewOptions& options);

}  // namespace belvedere::tools
