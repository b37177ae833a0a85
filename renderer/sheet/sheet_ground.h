#pragma once

#include <initializer_list>
#include <memory>
#include <optional>

#include "base/guidance_channels.h"
#include "base/run.h"
#include "renderer/paint/palette.h"
#include "renderer/rock/crest_shift.h"
#include "renderer/sheet/sheet_stage.h"
#include "renderer/world/lit_picture.h"
#include "renderer/world/world.h"
#include "texture/strokes/ice_plan.h"
#include "texture/strokes/stroke_painter.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {

// Where each class's paint would lie if the picture were painted in strokes alone: borders of copied ground get the shape of strokes.
struct PaintDraft {
  Grid<LandCoverClass> land_cover;  // whose paint shows
  Grid<glm::vec3> base;             // base colour of the place it grew from, encoded sRGB
  Grid<std::uint32_t> under;        // of a second class that shares the pixel: column (low 16 bits) and row of the sheet it grew from …
  Grid<std::uint8_t> under_share;   // … and its share, in 255ths; 0: there is none
};

// Everything of a sheet that needs no exemplar, made where it is asked for, in any rectangles, with the same bits as in one piece: traced
// guidance, relief of rock, light, base picture, draft. Memory and scratch files hold what was made until it is dropped. Each stage asks
// the one before it for its own rectangle and the margin that its paint or filter reaches.
class SheetGround {
 public:
  // All arguments must outlive it. tile_px: side of the tiles that are made at once, 64…4096; changes no bit.
  SheetGround(const World& world, const SheetView& view, const Palette& palette, TileStore::Place& place, const Run& run, int tile_px);

  PixelRect sheet() const { return traced_.sheet(); }
  const SheetView& view() const { return view_; }
  const StrokeParameters& strokes() const { return strokes_; }
  const World& world() const { return world_; }
  const Palette& palette() const { return palette_; }

  // Some traced channels of a rectangle, and the light where asked for.
  GuidanceBuffers read_guidance(PixelRect rect, std::initializer_list<GuidanceMember> channels, bool with_tone);
  // How many rows below each pixel the ground that it shows was traced (CrestShift::rows).
  Grid<std::int16_t> read_crest_rows(PixelRect rect) { return crests_.read(rect).rows; }
  // All that guidance.exr holds.
  GuidanceBuffers read_all_guidance(PixelRect rect);
  BasePicture read_base(PixelRect rect) { return base_.read(rect); }
  PaintDraft read_draft(PixelRect rect) { return draft_.read(rect); }
  // What synthesis is steered by.
  GuideStack read_guides(PixelRect rect);
  // What the reading of a rectangle makes first, for those who read several things of it (SheetStage::prepare).
  void prepare_base(PixelRect rect) { base_.prepare(rect); }
  void prepare_draft(PixelRect rect) { draft_.prepare(rect); }
  void prepare_guidance(PixelRect rect, bool with_relief, bool with_tone);

  // How ice runs on the sheet, made when first asked for.
  const IcePlan& ice();

  // What will yet be asked for of each; empty: nothing.
  struct Asked {
    PixelRect guidance;
    PixelRect base;
    PixelRect draft;  // guides as well
  };
  // Forgets what only other places were made for, and makes no more than what these need; to be asked for more costs time alone.
  void keep_only(const Asked& still);
  // How far a pixel of the draft looks around at the base picture, px.
  int draft_reach_px() const;

 private:
  GuidanceBuffers make_traced(PixelRect tile);
  CrestShift make_crests(PixelRect tile);
  RockRelief make_relief(PixelRect tile);
  // Traced channels with the crests of rock in place, before its relief.
  void prepare_crested(PixelRect rect);
  void read_crested(PixelRect rect, GuidanceBuffers& guidance);
  // What a rectangle of the sheet is seen with from afar, and where it begins (WideView::origin_px).
  struct Wide {
    GuidanceBuffers seen;
    glm::ivec2 origin_px;
  };
  Wide look_from_afar(PixelRect rect, int factor, SheetStage<GuidanceBuffers>& stage, std::initializer_list<GuidanceMember> channels);
  Wide read_wide(PixelRect rect);
  // The same for rock, at about a pixel a unit, with normals and footprints.
  Wide read_far(PixelRect rect);
  Grid<float> make_tone_tile(PixelRect tile);
  bool shows_water(PixelRect rect);
  BasePicture make_base(PixelRect tile);
  PaintDraft make_draft(PixelRect tile);

  const World& world_;
  const SheetView view_;
  const Palette& palette_;
  const Run& run_;
  TileStore::Place& place_;
  const RockParameters rock_parameters_;
  const ToneParameters tone_parameters_;
  const BaseParameters base_parameters_;
  const StrokeParameters strokes_;
  const int factor_;  // of wide views
  const std::unique_ptr<const Camera> wide_camera_;
  const int far_factor_;  // of what rock looks at
  const std::unique_ptr<const Camera> far_camera_;
  SheetStage<GuidanceBuffers> traced_;
  SheetStage<GuidanceBuffers> wide_;  // unused where the factor is 1: the pixels themselves are looked at
  SheetStage<GuidanceBuffers> far_;   // the same
  SheetStage<CrestShift> crests_;
  SheetStage<RockRelief> relief_;
  SheetStage<Grid<float>> tone_;
  SheetStage<BasePicture> base_;
  SheetStage<PaintDraft> draft_;
  std::optional<IcePlan> ice_;
};

// Strokes of the draft: of the ground as it is copied. What stands up, breaks or belongs to the sky is painted over it later.
inline constexpr StrokeLayers draft_layers{.sky = false, .breaks = false, .upright = false};
// What strokes ask of guidance, light included.
std::initializer_list<GuidanceMember> stroke_channels();
// Column and row of a place on the sheet as one number, and back; sheets are at most 65535 px wide and high.
inline std::uint32_t sheet_place(int x, int y) { return static_cast<std::uint32_t>(y) << 16U | static_cast<std::uint32_t>(x); }

}  // namespace belvedere
