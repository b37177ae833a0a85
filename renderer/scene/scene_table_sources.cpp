#include "renderer/scene/scene_table.h"

namespace belvedere {

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

}  // namespace belvedere
