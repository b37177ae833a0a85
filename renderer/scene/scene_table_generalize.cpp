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
       .meaning = "Terrain generalization by bands of landform size (Jenny, Jenny & Hurni 2011): 1 keeps a band, 0 removes it, more "
                  "exaggerates it. Each band holds landforms twice as large as the next.",
       .keys = {
           {.name = "preset",
            .field = AT(generalize.preset),
            .meaning = "Weights and masks by name; keys written beside it have the last word. See generalization.md.",
            .text = TextKind::choice,
            .choices = preset_choices()},
           {.name = "foreground",
            .field = AT(generalize.bands.foreground),
            .range = {0, 5},
            .meaning = "Weights of the bands near the viewer, the band of the largest landforms first. Their number is the number of "
                       "bands, 1 to 12."},
           {.name = "background",
            .field = AT(generalize.bands.background),
            .range = {0, 5},
            .meaning = "Weights of the bands far away, as many as in foreground; not written, they are as near, unless the preset has two "
                       "different sets. So are the other background sets."},
           {.name = "foreground_ridges",
            .field = AT(generalize.bands.foreground_ridges),
            .range = {-5, 5},
            .meaning =
                "Added to the foreground's weights along ridges: restores their detail, or sharpens them. As many as in foreground."},
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
           {.name = "foreground_to_m",
            .field = AT(generalize.foreground_to_m),
            .range = {0, largest_m},
            .unit = "m",
            .meaning = "Up to this distance the foreground's weights hold alone.",
            .derived = ".42 of the distance of the view's horizon"},
           {.name = "background_from_m",
            .field = AT(generalize.background_from_m),
            .range = {0, largest_m},
            .unit = "m",
            .meaning = "From this distance the background's weights hold alone; between the two they blend in a straight line, whose "
                       "ends are rounded over an eighth of it.",
            .derived = ".95 of the distance of the horizon"},
           {.name = "print_detail_px",
            .field = AT(generalize.print_detail_px),
            .range = {0, 20},
            .meaning =
                "Landforms shorter than so many output pixels fade, and are gone at half of it: the farther away, the larger. 2.5 is "
                "what a print shows; 0 is off."},
           {.name = "curvature",
            .field = AT(generalize.curvature),
            .meaning = "How ridges and valley lines are found: bounded is quiet in flats, plan finds gentle ones too.",
            .text = TextKind::choice,
            .choices = {"bounded", "plan"}},
           {.name = "full_curvature",
            .field = AT(generalize.bands.full_curvature),
            .range = {0, 10},
            .meaning = "Curvature times cell of a full ridge; less makes more of the ground a ridge. 0 is the usual one, 0.15 bounded, 0.8 "
                       "plan."},
           {.name = "blur_cells",
            .field = AT(generalize.bands.blur_cells),
            .range = {0, 10},
            .meaning = "Softens the edge between ridge and slope, in cells of each band; without it ridges grow spikes."},
           {.name = "exponent",
            .field = AT(generalize.bands.exponent),
            .range = {0, 4},
            .meaning = "1 keeps detail on ridges and valley lines only, less gives slopes more of it, 0 as much as ridges."},
           {.name = "mask_slope_deg",
            .field = AT(generalize.mask_slope_deg),
            .range = {0, 89},
            .unit = "°",
            .meaning = "Ground flatter than the first stays as it is, steeper than the second is generalized. [0, 0] is off."},
           {.name = "automatic_mask",
            .field = AT(generalize.automatic_mask),
            .meaning = "Exaggerates nothing on flat ground at the foot of slopes, where it would dig a moat; smoothing goes on there."},
           {.name = "mask",
            .field = AT(generalize.mask),
            .meaning = "Raster that says where terrain is generalized: 0 stays as it is, 1 (or 255) is generalized. Masks combine.",
            .text = TextKind::file,
            .raster = true},
           {.name = "mask_classes",
            .field = AT(generalize.mask_classes),
            .range = {0, 1},
            .meaning = "How much of the generalization land-cover classes take: { valley_floor = 0.2 }. Others take all of it.",
            .choices = ground_class_names()},
           {.name = "crest", .field = AT(generalize.bands.crest), .range = {0, 3}, .meaning = "Sharpening of high crests; 0 is off."},
           {.name = "keep_lakes", .field = AT(generalize.keep_lakes), .meaning = "Lakes keep their level."},
           {.name = "destripe",
            .field = AT(generalize.destripe),
            .meaning = "Finds stripes along rows and columns of the DEM (old USGS and SRTM data, resampling by nearest neighbours) and "
                       "takes them off before anything else."},
           {.name = "line_integral",
            .field = AT(generalize.line_integral),
            .meaning = "Before the bands, slopes are made plain along slope lines and ridges kept sharp (line integral convolution, Jenny "
                       "2021)."},
           {.name = "widen_valleys_m",
            .field = AT(generalize.valleys.width_m),
            .range = {0, 5000},
            .unit = "m",
            .meaning = "After the bands, the floors of large valleys become so much wider; ridges keep their place. 0 is off."},
       }}};
}

}  // namespace belvedere
