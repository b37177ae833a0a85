#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "base/land_cover_class.h"
#include "base/progress.h"
#include "renderer/exemplar/scan.h"
#include "renderer/paint/composite.h"
#include "renderer/paint/palette.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/view.h"

namespace belvedere {

// All exemplars of a scene: its paintings (read_scans), and example sheets in the style of its view
// for blocks without a painting; one example sheet if there is nothing else. Texture models
// (texture_models.h) are separate.
std::vector<PaintedExemplar> make_exemplars(const LoadedScene& scene, const View& view,
                                            const Palette& palette,
                                            std::vector<ScannedPainting> scans, Progress& progress,
                                            const Cache& cache = no_cache());

// Names of those exemplars and of texture models, and the classes of which they have texels,
// without painting the sheets.
struct ExemplarClasses {
  using Flags = std::array<bool, land_cover_class_count>;
  std::vector<std::string> names;
  std::vector<Flags> offered_by;  // by each of `names`
  Flags offered{};                // by any
};
ExemplarClasses look_at_classes(const LoadedScene& scene,
                                const std::vector<ScannedPainting>& scans);

}  // namespace belvedere
