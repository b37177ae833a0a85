#pragma once

#include <memory>

#include "base/run.h"
#include "renderer/style/style.h"
#include "renderer/world/lazy_value.h"
#include "renderer/world/world.h"
#include "texture/strokes/ice/ice_plan.h"

namespace belvedere {

// Measures of the whole sheet that a style needs: the extent of its sky and the range of distances
// of its ground.
struct StyleSight {
  int sky_rows = 0;  // from the sheet's top down to its lowest sky, px; 0: none
  double near_m = StylePaintParameters{}.near_m;  // 3 % of the ground are nearer,
  double far_m = StylePaintParameters{}.far_m;    // and 3 % are farther than this
};
// Measures a view of the sheet, reduced by the factor `scale`, by its distances.
StyleSight style_sight_of(const Grid<float>& depth_m, int scale);

// A style with its parameters for one sheet.
struct SheetStyle {
  Style style;
  StylePaintParameters parameters;  // without those of `sight`
  std::shared_ptr<const LazyValue<StyleSight>> sight = nullptr;
  // The parameters with those of `sight`, from a reduced view of the whole sheet with one ray per
  // pixel and about 400 columns, so that all parts of a sheet use the same values. Computed on
  // first use.
  StylePaintParameters seen() const;
};
// `world` and `camera` must outlive it.
std::shared_ptr<const SheetStyle> make_sheet_style(const Style& style,
                                                   const StylePaintParameters& parameters,
                                                   const World& world, const Camera& camera,
                                                   const Run& run);

// The flow of ice on the sheet of a world, from one trace of the whole sheet at about one pixel per
// unit (0.5 mm) and one ray per pixel. The same for every part of the sheet and for every reduced
// view of it. Not traced if the land cover has no ice.
IcePlan make_ice_plan(const World& world, const Run& run);

}  // namespace belvedere
