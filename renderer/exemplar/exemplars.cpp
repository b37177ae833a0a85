#include "renderer/exemplar/exemplars.h"

#include <utility>

#include "renderer/exemplar/example_sheet.h"

namespace belvedere {

std::vector<PaintedExemplar> make_exemplars(const LoadedScene& loaded, const View& view, const Palette& palette,
                                            std::vector<ScannedPainting> scans, Progress& progress) {
  const Scene& scene = loaded.scene;
  std::vector<PaintedExemplar> exemplars;
  for (std::size_t i = 0; i < scene.exemplars.size(); ++i) {
    if (scene.exemplars[i].picture.empty())
      exemplars.push_back(paint_example_sheet(scene.exemplars[i], scene, view, palette, progress));
    else if (i < scans.size() && !scans[i].painted.picture.empty())
      exemplars.push_back(std::move(scans[i].painted));
  }
  if (exemplars.empty()) exemplars.push_back(paint_example_sheet({}, scene, view, palette, progress));
  return exemplars;
}

}  // namespace belvedere
