#pragma once

#include <vector>

#include "base/progress.h"
#include "renderer/exemplar/scan.h"
#include "renderer/paint/palette.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

// What a scene is painted with: read, and refused where it is wrong, before the terrain is.
struct ScenePaint {
  std::vector<ScannedPainting> paintings;  // one for each exemplar block; empty where the scene copies neither strokes nor colours
  Palette palette;                         // the scene's, or the paintings' colours in it
};
ScenePaint read_scene_paint(const LoadedScene& scene, Progress& progress);
// The palette alone: for what is never copied. Reads paintings only where the colours are theirs.
Palette read_scene_palette(const LoadedScene& scene, Progress& progress);

// All that a scene's files may be refused for without reading its terrain, in one place, so that a check passes nothing that rendering
// refuses: missing files, paintings that cannot be read whole, whose colours or strokes the picture would have. Cheap beside reading them.
void require_inputs(const LoadedScene& scene);

}  // namespace belvedere
