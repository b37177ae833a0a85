#include "renderer/scene/scene_table.h"
#include "terrain/generalize/generalize_presets.h"

namespace belvedere {
namespace {

std::vector<std::string> preset_choices() {
  std::vector<std::string> names = {""};
  for (const GeneralizePreset& preset : generalize_presets()) names.emplace_back(preset.name);
  return names;
}

}  // namespace

std::vector<SceneSection> make_generalize_sections() {
  return {
      {.name = "generalize",
       .meaning = "Terrain generalization by bands of landform size (Jenny, Jenny & Hurni 2011): 1 "
                  "keeps a band, 0 removes it, more than 1 exaggerates it. Each band holds "
                  "landforms twice as large as the next.",
       .keys = {
           {.name = "preset",
            .field = AT(generalize.preset),
            .meaning = "Named weights and masks; keys given beside it override them. See "
                       "generalization.md.",
            .text = TextKind::choice,
            .choices = preset_choices()},
           {.name = "foreground",
            .field = AT(generalize.bands.foreground),
            .range = {0, 5},
            .meaning = "Weights of the bands near the viewer, the band of the largest landforms "
                       "first. Their number is the number of bands, 1 to 12."},
           {.name = "background",
            .field = AT(generalize.bands.background),
            .range = {0, 5},
            .meaning = "Weights of the bands far away, as many as in foreground. Default: as in "
                       "foreground, unless the preset has two different sets; so too for the other "
                       "background sets."},
           {.name = "foreground_ridges",
            .field = AT(generalize.bands.foreground_ridges),
            .range = {-5, 5},
            .meaning = "Added to the foreground's weights along ridges: restores or sharpens their "
                       "detail. As many as in foreground."},
           {.name = "foreground_valleys",
            .field = AT(generalize.bands.foreground_valleys),
            .range = {-5, 5},
            .meaning = "The same along valley lines."},
           {.name = "background_ridges",
            .field = AT(generalize.bands.background_ridges),
            .range = {-5, 5},
            .meaning = "Added to the background's weights along ridges."},
           {.name = "background_valleys",
            .field = AT(generalize.bands.background_valleys),
            .range = {-5, 5},
            .meaning = "The same along valley lines."},
           {.name = "base",
            .field = AT(generalize.bands.base),
            .range = {0, 5},
            .meaning = "Weight of what is larger than all bands, near and far: 1.2 raises the land "
                       "as a whole by a fifth of its altitude, 0.8 lowers it."},
           {.name = "foreground_to_m",
            .field = AT(generalize.foreground_to_m),
            .range = {0, largest_m},
            .unit = "m",
            .meaning = "Up to this distance only the foreground's weights apply.",
            .derived = "0.42 times the distance of the view's horizon"},
           {.name = "background_from_m",
            .field = AT(generalize.background_from_m),
            .range = {0, largest_m},
            .unit = "m",
            .meaning = "From this distance only the background's weights apply. Between the two "
                       "they blend linearly, rounded over an eighth inside both ends.",
            .derived = "0.95 times the distance of the horizon"},
           {.name = "print_detail_px",
            .field = AT(generalize.print_detail_px),
            .range = {0, 20},
            .meaning = "Landforms smaller than this many output pixels fade and vanish at half of "
                       "it, so that smoothing grows with distance. 2.5 suits print; 0: off."},
           {.name = "curvature",
            .field = AT(generalize.curvature),
            .meaning = "Curvature that finds ridges and valley lines: bounded is quiet in flats, "
                       "plan also finds gentle ones.",
            .text = TextKind::choice,
            .choices = {"bounded", "plan"}},
           {.name = "full_curvature",
            .field = AT(generalize.bands.full_curvature),
            .range = {0, 10},
            .meaning = "Curvature times cell size of a full ridge; a smaller value makes more of "
                       "the ground a ridge. 0: the default, 0.15 for bounded, 0.8 for plan."},
           {.name = "blur_cells",
            .field = AT(generalize.bands.blur_cells),
            .range = {0, 10},
            .meaning = "Width of the transition between ridge and slope, in cells of each band; "
                       "without it ridges grow spikes."},
           {.name = "exponent",
            .field = AT(generalize.bands.exponent),
            .range = {0, 4},
            .meaning = "1 keeps detail on ridges and valley lines only, smaller values give slopes "
                       "more of it, 0 as much as ridges."},
           {.name = "mask_slope_deg",
            .field = AT(generalize.mask_slope_deg),
            .range = {0, 89},
            .unit = "°",
            .meaning = "Ground flatter than the first is unchanged, ground steeper than the second "
                       "is generalized. [0, 0]: off."},
           {.name = "automatic_mask",
            .field = AT(generalize.automatic_mask),
            .meaning = "Applies no exaggeration to flat ground at the foot of slopes, where it "
                       "would dig a moat; smoothing still applies."},
           {.name = "mask",
            .field = AT(generalize.mask),
            .meaning = "Raster mask of the generalization: 0 unchanged, 1 (or 255) generalized. "
                       "Masks combine.",
            .text = TextKind::file,
            .raster = true},
           {.name = "mask_classes",
            .field = AT(generalize.mask_classes),
            .range = {0, 1},
            .meaning = "Share of the generalization by land-cover class: { valley_floor = 0.2 }. "
                       "Other classes take all of it.",
            .choices = ground_class_names()},
           {.name = "crest",
            .field = AT(generalize.bands.crest),
            .range = {0, 3},
            .meaning = "Sharpening of high crests; 0: off."},
           {.name = "keep_lakes",
            .field = AT(generalize.keep_lakes),
            .meaning = "Lakes keep their level."},
           {.name = "destripe",
            .field = AT(generalize.destripe),
            .meaning = "Finds stripes along rows and columns of the DEM (old USGS and SRTM data, "
                       "nearest-neighbour resampling) and removes them before anything else."},
           {.name = "line_integral",
            .field = AT(generalize.line_integral),
            .meaning = "Before the bands: smooths slopes along slope lines and keeps ridges sharp "
                       "(line integral convolution, Jenny 2021)."},
           {.name = "widen_valleys_m",
            .field = AT(generalize.valleys.width_m),
            .range = {0, 5000},
            .unit = "m",
            .meaning = "After the bands: widens the floors of large valleys by this distance; "
                       "ridges keep their position. 0: off."},
       }}};
}

}  // namespace belvedere
