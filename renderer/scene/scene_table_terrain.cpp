#include "renderer/scene/scene_table.h"

namespace belvedere {

std::vector<SceneSection> make_terrain_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "terrain",
       .meaning = "Where the heights come from: rasters, or a made-up terrain. With neither, a made-up one.",
       .keys = {
           {.name = "crs",
            .field = AT(terrain.dem.crs),
            .meaning = "Metric coordinate reference system of the scene, such as \"EPSG:32632\"; without it that of the first source, or "
                       "its UTM zone.",
            .text = TextKind::crs},
           {.name = "cell_m",
            .field = AT(terrain.dem.cell_m),
            .range = {0, 10000},
            .unit = "m",
            .meaning = "Size of a cell; 0 takes the finest source's."},
           {.name = "extent",
            .field = AT(terrain.dem.extent),
            .range = {-largest_m, largest_m},
            .unit = "m",
            .meaning = "The part to use, [min E, min N, max E, max N] in the scene's CRS; without it all there is."},
           {.name = "max_void_share",
            .field = AT(terrain.dem.max_void_share),
            .range = {0, 1},
            .meaning = "Holes in the data are filled; if they are more than this share of the area, it is an error instead."},
           {.name = "most_mcells",
            .field = AT(terrain.most_mcells),
            .range = {0, 1e6},
            .unit = "millions of cells",
            .meaning = "Rasters of more cells are taken in coarser ones where the picture shows no more; 0 goes by --memory. Give a "
                       "number where several machines make one sheet, so that all see the same ground."},
       }});
  sections.push_back(
      {.name = "terrain.sources",
       .kind = SectionKind::list,
       .meaning = "One block for each elevation raster. Where several overlap, the first one wins and the others fill its holes.",
       .keys = make_source_keys(true),
       .count = [](const Scene& s) { return s.terrain.sources.size(); },
       .resize = [](Scene& s, std::size_t n) { s.terrain.sources.resize(n); }});
  sections.push_back(
      {.name = "terrain.synthetic",
       .kind = SectionKind::optional,
       .meaning = "A made-up alpine terrain, cut by rivers and glaciers, in metric coordinates of its own.",
       .keys =
           {
               {.name = "width",
                .field = AT(terrain.synthetic->width),
                .range = {16, 16384},
                .unit = "cells",
                .meaning = "From west to east."},
               {.name = "height",
                .field = AT(terrain.synthetic->height),
                .range = {16, 16384},
                .unit = "cells",
                .meaning = "From north to south."},
               {.name = "cell_m", .field = AT(terrain.synthetic->cell_m), .range = {1, 1000}, .unit = "m", .meaning = "Size of a cell."},
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
                .meaning = "Another number gives other mountains."},
           },
       .count = [](const Scene& s) { return s.terrain.synthetic ? std::size_t{1} : std::size_t{0}; },
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
