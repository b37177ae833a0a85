#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/guidance_buffers.h"
#include "base/land_cover_class.h"
#include "base/pixel_rect.h"
#include "renderer/paint/composite.h"
#include "texture/statistical/make_texture.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {

// A texture model that ground is painted from, and what its windows are made with.
struct GroundModel {
  CliqueModel model;
  TextureRecord record;
  std::uint64_t seed = 1;
  double light_px = 6.0;  // what is larger in the texture than this is its light: the residual takes that away
};

// Which classes of a sheet are painted from models instead of copied.
struct GroundModels {
  static constexpr std::uint8_t none = 255;
  using OfClass = std::array<std::uint8_t, land_cover_class_count>;  // model by class id

  std::vector<GroundModel> models;
  OfClass lit = no_class();     // of ground in the light
  OfClass shaded = no_class();  // and in the shade; `none` for the same classes

  static constexpr OfClass no_class() {
    OfClass all{};
    all.fill(none);
    return all;
  }
  bool any() const { return lit != no_class(); }
  bool by_light() const { return lit != shaded; }
  bool uses(std::size_t model) const {
    return std::find(lit.begin(), lit.end(), model) != lit.end() || std::find(shaded.begin(), shaded.end(), model) != shaded.end();
  }
};

// The paint of a tile of the sheet: each model's texture without end, at the sheet's own pixels, where `shown` (of the tile) has a class of
// its and there is no sky; classes with two models by `tone` (of the tile, 0…1; read for these alone). Streaks run down the fall line,
// level on water, fields and flat ground. `guidance` is that of `window`: the tile and model_margin_px around it, cut by the sheet; needs
// depth_m, land_cover and fall_line. A model is asked for the box of its classes in the tile alone, with endless_margin_px around it: tiles
// must be those of one lattice, for pixels to be the same whoever asks.
ModelPaint make_model_paint(const GroundModels& models, PixelRect tile, const Grid<LandCoverClass>& shown, const GuidanceBuffers& guidance,
                            PixelRect window, const Grid<float>& tone = {});
int model_margin_px(const GroundModels& models);

// Takes the classes of models out of what is to be copied.
void hide_modelled(GuideStack& guides, const GroundModels& models);

}  // namespace belvedere
