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
#include "texture/synthesis/exemplar.h"

namespace belvedere {

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
