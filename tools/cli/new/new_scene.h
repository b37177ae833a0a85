#pragma once

#include <string>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "tools/cli/new/new_options.h"

namespace belvedere::tools {

// Writes a scene of a region with the best view, or the one that is chosen: `belvedere new`.
int make_new_scene(const NewOptions& options);
// The text of that scene with the best view, for a file options.out; nothing is written but what
// --at fetches.
std::string new_scene_text(const NewOptions& options, const Cache& cache, Progress& progress);

}  // namespace belvedere::tools
