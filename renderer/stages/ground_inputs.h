#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "base/guidance_buffers.h"
#include "base/land_cover_class.h"
#include "base/pixel_rect.h"
#include "base/run.h"
#include "renderer/paint/base_picture.h"
#include "renderer/paint/composite.h"
#include "renderer/paint/light.h"
#include "renderer/paint/palette.h"
#include "renderer/rock/rock_relief.h"
#include "renderer/style/style.h"
#include "renderer/world/picture_parameters.h"
#include "renderer/world/world.h"
#include "texture/statistical/make_texture.h"
#include "texture/synthesis/exemplar.h"

// Shared by the declarations of stages (stages.h).

namespace belvedere {

struct SheetStyle;  // renderer/stages/sheet_style.h

// Inputs and parameters of the ground stages.
struct GroundInputs {
  // Without a world nothing can be made, but margins and memory can be computed.
  const World* world = nullptr;
  const Palette* palette = nullptr;
  Run run = {};
  const Camera* camera = nullptr;
  glm::ivec2 size_px{0};
  double pixels_per_unit = 1.0;  // pixels in .5 mm of the sheet
  double horizon_px = 0.0;       // SheetView::horizon_px
  SheetView view() const { return {*camera, pixels_per_unit, horizon_px}; }
  // Whether wide effects are computed in pixels of about half a unit (WideView) where the sheet's
  // are finer.
  bool wide_views = true;
  bool has_mist = false;
  // Whether crests and rock get the relief that a DEM does not contain; previews leave it out.
  bool rock_relief = true;
  // Traced channels of the whole sheet, if they exist already; null: traced tile by tile.
  std::shared_ptr<const GuidanceBuffers> traced = nullptr;
  RockParameters rock = {};
  ToneParameters tone = {};
  BaseParameters base = {};
  StrokeParameters strokes = {};
  std::shared_ptr<const SheetStyle> style = nullptr;  // null: painted in none
};
// Inputs without BaseParameters::mean_light, whose measurement needs them: see make_ground_inputs
// of lit_picture.h. All arguments must outlive the inputs.
GroundInputs make_unlit_inputs(const World& world, const SheetView& view, const Palette& palette,
                               const Run& run);
// Inputs for a scene whose world is not made yet, to compute the memory of its stages.
GroundInputs estimate_ground_inputs(const Scene& scene, double pixels_per_unit,
                                    const Style* style = nullptr);

// Memory per pixel of a window while strokes are laid on it, measured.
inline constexpr double stroke_work_bytes = 67.0;

// The inputs of a stage, in the order of its function's arguments.
template <class... Inputs>
std::tuple<Inputs...> inputs(Inputs... input) {
  return {std::move(input)...};
}

// Guidance channels that strokes read.
inline std::vector<GuidanceMember> stroke_channels() {
  using B = GuidanceBuffers;
  return {&B::depth_m,   &B::position_m,  &B::land_cover, &B::fall_line,
          &B::slope_deg, &B::footprint_m, &B::relief_s_m, &B::built,
          &B::grain,     &B::rock_facet,  &B::tone};
}

// A texture model for ground, and the parameters of its windows.
struct GroundModel {
  CliqueModel model;
  TextureRecord record;
  std::uint64_t seed = 1;
  double light_px =
      6.0;  // larger forms in the texture count as its light, which the residual removes
};

// The classes of a sheet that are painted from models instead of copied.
struct GroundModels {
  static constexpr std::uint8_t none = 255;
  using OfClass = std::array<std::uint8_t, land_cover_class_count>;  // model by class id

  std::vector<GroundModel> models;
  OfClass lit = no_class();     // of lit ground
  OfClass shaded = no_class();  // of shaded ground; `none` for the same classes

  static constexpr OfClass no_class() {
    OfClass all{};
    all.fill(none);
    return all;
  }
  bool any() const { return lit != no_class(); }
  bool by_light() const { return lit != shaded; }
  bool uses(std::size_t model) const {
    return std::find(lit.begin(), lit.end(), model) != lit.end() ||
           std::find(shaded.begin(), shaded.end(), model) != shaded.end();
  }
};

// The paint of a tile of the sheet: each model's unbounded texture, at the sheet's own pixels,
// where `shown` (of the tile) has one of its classes and there is no sky; classes with two models
// by `tone` (of the tile, 0…1; read for these only). Streaks run down the fall line, level on
// water, fields and flat ground. `guidance` covers `window`: the tile and model_margin_px around
// it, clipped to the sheet; needs depth_m, land_cover and fall_line. A model is evaluated for the
// box of its classes in the tile, with endless_margin_px around it: tiles must belong to one
// lattice for pixels to be the same in every request.
ModelPaint make_model_paint(const GroundModels& models, PixelRect tile,
                            const Grid<LandCoverClass>& shown, const GuidanceBuffers& guidance,
                            PixelRect window, const Grid<float>& tone = {});
int model_margin_px(const GroundModels& models);

// Removes the classes of models from those to be copied.
void hide_modelled(GuideStack& guides, const GroundModels& models);

}  // namespace belvedere
