#pragma once

#include <optional>
#include <vector>

#include "renderer/features/drawn_features.h"
#include "renderer/paint/composite.h"
#include "renderer/sheet/knit_ground.h"
#include "renderer/sheet/model_ground.h"
#include "renderer/sheet/picture_layers.h"
#include "renderer/sheet/sheet_ground.h"
#include "renderer/sheet/sheet_mist.h"
#include "texture/sheet/synthesis_plan.h"
#include "texture/sheet/synthesis_tile.h"
#include "texture/synthesis/match_field.h"

namespace belvedere {

// What the ground is copied from, and how it was chosen for the sheet as a whole.
struct CopyPlan {
  std::vector<PaintedExemplar> exemplars;
  std::optional<SynthesisPlan> synthesis;
  double residual = 0.75;           // how much of the base picture's difference is laid over a texel, 0…1
  GroundModels models;              // of classes that are not copied
  std::optional<KnitSources> knit;  // what seams are knitted by; none: they stay as they are copied
};

// The finished picture of a sheet in any rectangles, with the same bits as in one piece: copied ground, strokes over it, softened edges.
class SheetPicture {
 public:
  // Without a plan everything is painted as strokes. All arguments must outlive it.
  SheetPicture(SheetGround& ground, CopyPlan* plan, TileStore::Place& place, const Run& run, const DrawnFeatures& features = no_features());

  // Encoded sRGB.
  Grid<glm::vec3> make(PixelRect rect) { return make(rect, nullptr); }
  // The same, and the layers that make it when they are laid over each other.
  Grid<glm::vec3> make(PixelRect rect, PictureLayers* layers);
  // The same for matches alone.
  MatchField read_matches(PixelRect rect) { return matches_.read(rect); }

  // Forgets what only places outside of `still` need.
  void keep_only(PixelRect still);

 private:
  MatchField make_matches(PixelRect tile);
  ModelPaint make_modelled(PixelRect tile);
  KnitPaint make_knitted(PixelRect tile);
  // What copied ground of a rectangle looks at, made before memory is taken for it.
  PixelRect copy_window(PixelRect rect) const;
  void prepare_copy(PixelRect rect);
  Grid<glm::vec3> copy_ground(PixelRect rect);
  // Kinds of strokes that can reach a rectangle: those of the sky, by far the longest, begin where sky is seen.
  StrokeLayers layers_around(PixelRect rect);
  // How far around what is asked for finishing strokes look, px.
  int finish_margin_px(const StrokeLayers& layers) const;
  // Whether lines or houses may touch a rectangle, or keep ground there clear.
  bool has_features(PixelRect rect) const;

  SheetGround& ground_;
  CopyPlan* plan_;
  const Run& run_;
  const StrokeLayers layers_;
  const DrawnFeatures& features_;
  SheetMist mist_;
  SheetStage<MatchField> matches_;
  SheetStage<ModelPaint> modelled_;
  SeamModels seams_;
  SheetStage<KnitPaint> knitted_;
};

}  // namespace belvedere
