#pragma once

#include <vector>

#include "base/progress.h"
#include "renderer/exemplar/scan.h"
#include "renderer/paint/composite.h"
#include "renderer/paint/palette.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/view.h"

namespace belvedere {

// All exemplars of a scene: its paintings (read_scans), and example sheets in the hand of its view for the blocks that name none; one
// example sheet where there is nothing else.
std::vector<PaintedExemplar> make_exemplars(const LoadedScene& scene, const View& view, const Palette& palette,
                                            std::vector<ScannedPainting> scans, Progress& progress);

}  // namespace belvedere
