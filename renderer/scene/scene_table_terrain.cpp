#include "renderer/scene/scene_table.h"

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

}  // namespace belvedere
