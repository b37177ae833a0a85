#pragma once

#include <string>
#include <vector>

#include "base/run.h"
#include "renderer/scene/scene_file.h"

namespace belvedere::tools {

// Small, quick pictures of several views of one region, numbered, in one picture.
struct ContactSheetParameters {
  int width_px = 520;  // of each picture, 64…4000
  int columns = 2;     // of the sheet
};

// The scene as a small draft: few pixels, only strokes, ground of about `mcells` million cells (0:
// all).
LoadedScene make_small_draft(LoadedScene scene, int width_px, double mcells);

// Renders each scene (drafts, as make_small_draft makes them) and writes the sheet as PNG; each
// picture's name is below it.
void write_contact_sheet(const std::string& path, std::vector<LoadedScene> drafts,
                         const std::vector<std::string>& captions, const Run& run,
                         const ContactSheetParameters& parameters = {});

}  // namespace belvedere::tools
