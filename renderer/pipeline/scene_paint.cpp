#include "renderer/pipeline/scene_paint.h"

#include "renderer/exemplar/scan_palette.h"
#include "renderer/world/style/scene_style.h"

namespace belvedere {
namespace {

bool takes_colours(const Scene& scene) { return scene.synthesis.colours == "painting"; }
// Colours may be taken from a painting even if its strokes are not used.
bool reads_paintings(const Scene& scene) { return scene.copies() || takes_colours(scene); }

}  // namespace

ScenePaint read_scene_paint(const LoadedScene& loaded, Progress& progress) {
  ScenePaint paint;
  paint.style = named_style(loaded);
  paint.palette = named_palette(loaded);
  if (reads_paintings(loaded.scene)) paint.paintings = read_scans(loaded, progress);
  if (takes_colours(loaded.scene))
    paint.palette = take_colours(paint.palette, paint.paintings,
                                 with_stand_ins(loaded.scene.synthesis.fallback));
  return paint;
}

Palette read_scene_palette(const LoadedScene& loaded, Progress& progress) {
  return takes_colours(loaded.scene) ? read_scene_paint(loaded, progress).palette
                                     : named_palette(loaded);
}

void require_inputs(const LoadedScene& loaded) {
  require_scene_files(loaded);
  if (reads_paintings(loaded.scene)) check_paintings(loaded);
}

}  // namespace belvedere
