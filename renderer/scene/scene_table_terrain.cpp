#include "renderer/scene/scene_table.h"
#include "terrain/generalize/generalize_presets.h"

namespace belvedere {

std::vector<SceneSection> make_terrain_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "terrain",
       .meaning = "Source of the heights: rasters or synthetic terrain. Without either, synthetic "
                  "terrain.",
       .keys = {
           {.name = "crs",
            .field = AT(terrain.dem.crs),
            .meaning = "Metric coordinate reference system of the scene, such as \"EPSG:32632\". "
                       "Default: that of the first source, or its UTM zone.",
            .text = TextKind::crs},
           {.name = "cell_m",
            .field = AT(terrain.dem.cell_m),
            .range = {0, 10000},
            .unit = "m",
            .meaning = "Size of a cell; 0: the finest source's."},
           {.name = "extent",
            .field = AT(terrain.dem.extent),
            .range = {-largest_m, largest_m},
            .unit = "m",
            .meaning = "The area to use, [min E, min N, max E, max N] in the scene's CRS. Default: "
                       "the whole area of the data."},
           {.name = "max_void_share",
            .field = AT(terrain.dem.max_void_share),
            .range = {0, 1},
            .meaning = "Voids in the data are filled; if they are more than this share of the "
                       "area, it is an error instead."},
           {.name = "max_mcells",
            .field = AT(terrain.max_mcells),
            .range = {0, 1e6},
            .unit = "millions of cells",
            .meaning = "Rasters of more cells are resampled to coarser ones where the picture "
                       "shows no more; 0: limited by --memory. Give a number where several "
                       "machines make one sheet, so that all use the same ground."},
       }});
  sections.push_back({.name = "terrain.sources",
                      .kind = SectionKind::list,
                      .meaning = "One block for each elevation raster. Where several overlap, the "
                                 "first one wins and the others fill its voids.",
                      .keys = make_source_keys(true),
                      .count = [](const Scene& s) { return s.terrain.sources.size(); },
                      .resize = [](Scene& s, std::size_t n) { s.terrain.sources.resize(n); }});
  sections.push_back(
      {.name = "terrain.synthetic",
       .kind = SectionKind::optional,
       .meaning =
           "A synthetic alpine terrain, cut by rivers and glaciers, in its own metric coordinates.",
       .keys =
           {
               {.name = "width",
                .field = AT(terrain.synthetic->width),
                .range = {16, 16384},
                .unit = "cells",
                .meaning = "Extent from west to east."},
               {.name = "height",
                .field = AT(terrain.synthetic->height),
                .range = {16, 16384},
                .unit = "cells",
                .meaning = "Extent from north to south."},
               {.name = "cell_m",
                .field = AT(terrain.synthetic->cell_m),
                .range = {1, 1000},
                .unit = "m",
                .meaning = "Size of a cell."},
               {.name = "lowest_m",
                .field = AT(terrain.synthetic->lowest_m),
                .range = {-500, 8000},
                .unit = "m",
                .meaning = "Altitude of the lowest valley."},
               {.name = "highest_m",
                .field = AT(terrain.synthetic->highest_m),
                .range = {-400, 9000},
                .unit = "m",
                .meaning = "Altitude of the highest summit."},
               {.name = "seed",
                .field = AT(terrain.synthetic->seed),
                .range = {0, largest_seed},
                .meaning = "Random seed of the mountains."},
           },
       .count =
           [](const Scene& s) { return s.terrain.synthetic ? std::size_t{1} : std::size_t{0}; },
       .resize =
           [](Scene& s, std::size_t n) {
             if (n > 0)
               s.terrain.synthetic.emplace();
             else
               s.terrain.synthetic.reset();
           }});
  return sections;
}

std::vector<SceneKey> make_source_keys(bool heights) {
  // Land cover and heights share the keys of files; only heights have a unit.
  const auto source = [heights](auto terrain, auto cover) { return heights ? +terrain : +cover; };
  std::vector<SceneKey> keys = {
      {.name = "file",
       .field = source(AT(terrain.sources[i].file), AT(land_cover.sources[i].file)),
       .meaning = "Raster in any common format (GeoTIFF, ESRI ASCII, HGT …); with --allow-http "
                  "also its address, https://….",
       .text = TextKind::file,
       .required = true,
       .raster = true},
      {.name = "band",
       .field = source(AT(terrain.sources[i].raster.band), AT(land_cover.sources[i].raster.band)),
       .range = {1, 65535},
       .meaning = "Band of the file, counted from 1."},
      {.name = "variable",
       .field = source(AT(terrain.sources[i].raster.variable),
                       AT(land_cover.sources[i].raster.variable)),
       .meaning = "Name of the raster in a file that contains several (netCDF, GeoPackage), or "
                  "number of a page of a TIFF; without it an error lists them."},
      {.name = "crs",
       .field = source(AT(terrain.sources[i].raster.crs), AT(land_cover.sources[i].raster.crs)),
       .meaning =
           "Coordinate reference system, if the file has none or a wrong one: \"EPSG:26911\".",
       .text = TextKind::crs},
      {.name = "nodata",
       .field =
           source(AT(terrain.sources[i].raster.nodata), AT(land_cover.sources[i].raster.nodata)),
       .range = {-1e38, 1e38},
       .meaning = "Value that means no data. Default: that of the file."},
      {.name = "origin",
       .field = source(AT(terrain.sources[i].origin), AT(land_cover.sources[i].origin)),
       .meaning = "Who made the data."},
      {.name = "licence",
       .field = source(AT(terrain.sources[i].licence), AT(land_cover.sources[i].licence)),
       .meaning = "Under which terms it may be used."},
      {.name = "get_from",
       .field = source(AT(terrain.sources[i].get_from), AT(land_cover.sources[i].get_from)),
       .meaning = "Where to get it; shown when the file is missing."},
  };
  if (heights) {
    keys.insert(keys.begin() + 3,
                {.name = "encoding",
                 .field = AT(terrain.sources[i].raster.encoding),
                 .meaning = "How the red, green and blue of map tiles encode heights. terrarium: "
                            "256 R + G + B / 256 - 32768; mapbox: Terrain-RGB, 0.1 (65536 R + 256 "
                            "G + B) - 10000. Default: the values are heights.",
                 .text = TextKind::choice,
                 .choices = {"", "terrarium", "mapbox"}});
    keys.insert(
        keys.begin() + 4,
        {.name = "unit",
         .field = AT(terrain.sources[i].unit),
         .meaning = "Unit of the heights, if the file does not give it; us-ft is the survey foot.",
         .text = TextKind::choice,
         .choices = {"", "m", "ft", "us-ft"}});
    keys.insert(keys.begin() + 7,
                {.name = "lowest_m",
                 .field = AT(terrain.sources[i].raster.lowest_m),
                 .range = {-12000, 9000},
                 .unit = "m",
                 .meaning = "Lower heights are errors of the data and count as voids."});
    keys.insert(keys.begin() + 8,
                {.name = "highest_m",
                 .field = AT(terrain.sources[i].raster.highest_m),
                 .range = {-12000, 9000},
                 .unit = "m",
                 .meaning = "Higher heights are errors of the data and count as voids."});
  }
  return keys;
}

SceneKey make_vector_crs_key(SceneField (*field)(Scene&, std::size_t), std::string_view name) {
  return {.name = name,
          .field = field,
          .meaning =
              "Coordinate reference system of the file, if it has none or a wrong one: "
              "\"EPSG:26911\"; of a .csv that of its columns east and north.",
          .text = TextKind::crs};
}

SceneKey make_encoding_key(SceneField (*field)(Scene&, std::size_t), std::string_view name) {
  return {.name = name,
          .field = field,
          .meaning =
              "Encoding of the texts of a .shp or .csv file, such as \"windows-1252\". "
              "Default: as the .cpg file says, else UTF-8."};
}

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
