#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/cache/cache.h"
#include "base/land_cover_class.h"
#include "base/run.h"
#include "renderer/exemplar/example_painting.h"
#include "renderer/exemplar/example_sheet_plan.h"
#include "renderer/paint/composite.h"
#include "renderer/scene/scene.h"
#include "renderer/world/view.h"

namespace belvedere {

// What an example sheet takes over from the picture that will copy it.
struct ExampleSheetHand {
  Palette palette;
  std::optional<LightParameters> light;  // else each panel's own
};

// Paints the panels of an example sheet, row by row. Terrains that several panels show are made once.
class ExampleSheetPainter {
 public:
  ExampleSheetPainter(ExampleSheetPlan plan, ExampleSheetHand hand);
  ~ExampleSheetPainter();
  ExampleSheetPainter(ExampleSheetPainter&&) noexcept;

  const ExampleSheetPlan& plan() const;
  int rows() const;
  // Rows of pixels that a row of panels covers, margins included.
  std::pair<int, int> row_span(int row) const;
  // What rays were traced with, for provenance; known after the first row.
  const std::string& instruction_set() const;
  // A row of panels with their margins, as wide as the example sheet. painted_from and ground_from count in the pixels of the whole of it.
  // Margins are bare paper: they count as sky, and nothing is copied from them.
  ExamplePainting paint_row(int row, const ExampleLayers& layers, const Run& run);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The name of its exemplar, in messages.
inline constexpr const char* example_sheet_name = "painted sheet";

// The example sheet that is painted for a picture: with its palette, light and size of stroke, so that every guide of it is exactly known.
// It carries no trees, no houses and no sky: those are painted on the target last. The cache keeps it, and the terrains of its panels with
// their land cover: pictures with another sun or another palette share these.
PaintedExemplar paint_example_sheet(const SceneExemplar& settings, const Scene& scene, const View& view, const Palette& palette,
                                    Progress& progress, const Cache& cache = no_cache());

// Width and height of the sheet that is painted for a print of that many pixels: as the scene says, else a texel for eight pixels of it,
// 10 : 7, from 2000 × 1400 to 24 Mpx. Fewer, and a large print repeats; what more would cost is not seen.
glm::ivec2 example_sheet_size(const SceneExemplar& settings, const SceneOutput& output);

// The classes that such a sheet has texels of, known without painting it where it is large enough; else it is painted.
std::vector<LandCoverClass> classes_of_example_sheet(const SceneExemplar& settings, const Scene& scene, const View& view,
                                                     const Palette& palette, Progress& progress, const Cache& cache = no_cache());

}  // namespace belvedere
