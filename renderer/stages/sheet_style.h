#pragma once

#include <memory>

#include "base/run.h"
#include "renderer/style/style_parameters.h"
#include "renderer/world/lazy_value.h"
#include "renderer/world/world.h"

namespace belvedere {

// What a style asks of the whole sheet: how far down its sky reaches, and between which distances
// its ground lies.
struct StyleSight {
  int sky_rows = 0;  // from the sheet's top down to its lowest sky, px; 0: none
  double near_m = StylePaintParameters{}.near_m;  // nearer than this lie 3 % of the ground,
  double far_m = StylePaintParameters{}.far_m;    // farther than this as much
};
// Of distances of a view of the sheet in pixels `scale` times as large.
StyleSight style_sight_of(const Grid<float>& depth_m, int scale);

// A style as a sheet is painted in it.
struct SheetStyle {
  Style style;
  StylePaintParameters parameters;  // without what only a look at the sheet tells
  std::shared_ptr<const LazyValue<StyleSight>> sight = nullptr;
  // With it: from one look at the whole sheet, a ray a pixel, of some 400 columns, so that every
  // part of it is painted alike. Made when a stage first asks.
  StylePaintParameters seen() const;
};
// `world` and `camera` must outlive it.
std::shared_ptr<const SheetStyle> make_sheet_style(const Style& style,
                                                   const StylePaintParameters& parameters,
                                                   const World& world, const Camera& camera,
                                                   const Run& run);

}  // namespace belvedere
