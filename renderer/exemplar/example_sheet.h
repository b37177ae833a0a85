#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/cache/cache.h"
#include "base/land_cover_class.h"
#include "base/run.h"
#include "renderer/exemplar/example_sheet_plan.h"
#include "renderer/paint/composite.h"
#include "renderer/paint/guides.h"
#include "renderer/scene/scene.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/world/view.h"

namespace belvedere {

// The header note in a painting's file that names its layer, and its value for the layer without
// trees.
inline constexpr const char* exemplar_layer_note = "belvedere:layer";
inline constexpr const char* exemplar_ground_layer = "ground";

// A view painted entirely in strokes, with full guidance for every pixel.
struct ExamplePainting {
  GuidanceBuffers guidance;      // with painted_class, painted_from, stroke and ground_from
  Grid<glm::vec3> painting;      // encoded sRGB, edges of depth softened
  Grid<glm::vec3> ground_layer;  // without trees, dwarf pines, houses and ice breaks, with hard
                                 // edges: what synthesis copies
};

// The layers to paint: each costs a painting of its own.
struct ExampleLayers {
  bool painting = true;  // otherwise painting, painted_class, painted_from and stroke stay empty
  bool sky = true;       // otherwise the sky keeps the base picture's
};

// Paints a view; `picture` must cover all of it. The same bits for any number of threads.
ExamplePainting paint_example(const World& world, const Palette& palette, LitPicture picture,
                              const ExampleLayers& layers, Progress& progress);

// Base colour and class of the paint on every pixel, from the pixels where its strokes begin: used
// for the residual and labels of an exemplar.
PaintedClasses classes_of_paint(const GuidanceBuffers& guidance, const Grid<std::uint32_t>& from);

// Properties that an example sheet takes from the picture that will copy it.
struct ExampleSheetHand {
  Palette palette;
  std::optional<LightParameters> light;  // otherwise each panel's own
};

// Paints the panels of an example sheet, row by row. Terrains shared by several panels are made
// once.
class ExampleSheetPainter {
 public:
  ExampleSheetPainter(ExampleSheetPlan plan, ExampleSheetHand hand);
  ~ExampleSheetPainter();
  ExampleSheetPainter(ExampleSheetPainter&&) noexcept;

  const ExampleSheetPlan& plan() const;
  int rows() const;
  // Rows of pixels that a row of panels covers, margins included.
  std::pair<int, int> row_span(int row) const;
  // Instruction set of the rays, for provenance; known after the first row.
  const std::string& instruction_set() const;
  // A row of panels with their margins, as wide as the example sheet. Indices in painted_from and
  // ground_from refer to the whole of it. Margins are bare paper: they count as sky, and nothing is
  // copied from them.
  ExamplePainting paint_row(int row, const ExampleLayers& layers, const Run& run);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The name of the exemplar of an example sheet, in messages.
inline constexpr const char* example_sheet_name = "painted sheet";

// The example sheet that is painted for a picture: with its palette, light and size of strokes, so
// that all its guides are known exactly. It has no trees, houses or sky, because those are painted
// on the target last. The sheet is cached, and so are the terrains and land cover of its panels,
// which pictures with another sun or palette share.
PaintedExemplar paint_example_sheet(const SceneExemplar& settings, const Scene& scene,
                                    const View& view, const Palette& palette, Progress& progress,
                                    const Cache& cache = no_cache());

// Size of the sheet for a print of that many pixels: as in the scene, else one texel for eight
// pixels, 10 : 7, from 2000 × 1400 to 24 Mpx. With fewer texels a large print repeats; more bring
// no visible gain.
glm::ivec2 example_sheet_size(const SceneExemplar& settings, const SceneOutput& output);

// The classes that such a sheet has texels of: those that occur in panoramas. One of less than 500
// × 350 texels may lack some.
std::vector<LandCoverClass> classes_of_example_sheet();

}  // namespace belvedere
