#include "renderer/scene/scene_table.h"

namespace belvedere {

namespace {

SceneSection make_light_region_section() {
  return {
      .name = "light.regions",
      .kind = SectionKind::list,
      .meaning =
          "One block for each part of the map with its own light, for example to light a range "
          "that would be in shade; see light.md. A circle, an outline, or the areas of a file; "
          "later blocks override earlier ones.",
      .keys =
          {
              {.name = "name", .field = AT(light_regions[i].name), .meaning = "Name for messages."},
              {.name = "position",
               .field = AT(light_regions[i].position),
               .range = {-largest_m, largest_m},
               .unit = "m",
               .meaning = "The centre of a circle, [E, N] in the scene's CRS."},
              {.name = "position_lonlat",
               .field = AT(light_regions[i].position_lonlat),
               .unit = "°",
               .meaning = "The centre, [longitude, latitude]; instead of position.",
               .lonlat = true},
              {.name = "radius_m",
               .field = AT(light_regions[i].radius_m),
               .range = {1, 1e6},
               .unit = "m",
               .meaning = "Radius of the circle, within which its light applies in full."},
              {.name = "points",
               .field = AT(light_regions[i].points),
               .range = {-largest_m, largest_m},
               .unit = "m",
               .meaning = "The corners of an outline, [[E, N], …], instead of a circle."},
              {.name = "points_lonlat",
               .field = AT(light_regions[i].points_lonlat),
               .unit = "°",
               .meaning = "The corners by longitude and latitude.",
               .lonlat = true},
              {.name = "file",
               .field = AT(light_regions[i].file),
               .meaning = "A .gpkg, .geojson, .shp or .fgb file whose areas all have this light; "
                          "instead of a circle.",
               .text = TextKind::file},
              make_vector_crs_key(AT(light_regions[i].source.crs)),
              make_encoding_key(AT(light_regions[i].source.encoding)),
              {.name = "layer",
               .field = AT(light_regions[i].layer),
               .meaning = "The layer of the file. Default: all layers."},
              {.name = "where",
               .field = AT(light_regions[i].where),
               .meaning =
                   "Only areas that meet this condition, as in SQL: \"name = 'Vomper Kette'\"."},
              {.name = "origin",
               .field = AT(light_regions[i].origin),
               .meaning = "Who made the file; shown by check, written to the headers."},
              {.name = "licence", .field = AT(light_regions[i].licence), .meaning = "Its licence."},
              {.name = "get_from",
               .field = AT(light_regions[i].get_from),
               .meaning = "Where to get it; shown when it is missing."},
              {.name = "optional",
               .field = AT(light_regions[i].optional),
               .meaning =
                   "If its file is missing, leave the block out with a note instead of an error."},
              {.name = "azimuth_deg",
               .field = AT(light_regions[i].azimuth_deg),
               .range = {-360, 720},
               .unit = "°",
               .meaning = "Azimuth of its sun, clockwise from north. Default, also without "
                          "turn_deg: that of the scene."},
              {.name = "turn_deg",
               .field = AT(light_regions[i].turn_deg),
               .range = {-180, 180},
               .unit = "°",
               .meaning = "Angle of its sun clockwise from the scene's; instead of azimuth_deg."},
              {.name = "altitude_deg",
               .field = AT(light_regions[i].altitude_deg),
               .range = {1, 90},
               .unit = "°",
               .meaning = "Height of its sun above the horizon. Default: that of the scene."},
              {.name = "strength",
               .field = AT(light_regions[i].strength),
               .range = {0, 2},
               .meaning =
                   "Factor on the sunlight: less than 1 subdues a range, more emphasizes it."},
              {.name = "warmth",
               .field = AT(light_regions[i].warmth),
               .range = {-1, 1},
               .meaning = "Shift of the palette's lit colours to warm ones, or below 0 to cool "
                          "ones; shade keeps its colours."},
              {.name = "blend_m",
               .field = AT(light_regions[i].blend_m),
               .range = {0, 1e6},
               .unit = "m",
               .meaning = "Width of the transition to the surrounding light, outside."},
          },
      .count = [](const Scene& s) { return s.light_regions.size(); },
      .resize = [](Scene& s, std::size_t n) { s.light_regions.resize(n); }};
}

SceneSection make_light_cloud_section() {
  return {
      .name = "light.clouds",
      .kind = SectionKind::list,
      .meaning =
          "One block for each cloud shadow: a dark patch with soft, lobed edges that sets off lit "
          "ground behind or before it.",
      .keys =
          {
              {.name = "name", .field = AT(light_clouds[i].name), .meaning = "Name for messages."},
              {.name = "position",
               .field = AT(light_clouds[i].position),
               .range = {-largest_m, largest_m},
               .unit = "m",
               .meaning = "Its centre, [E, N] in the scene's CRS."},
              {.name = "position_lonlat",
               .field = AT(light_clouds[i].position_lonlat),
               .unit = "°",
               .meaning = "Its centre, [longitude, latitude]; instead of position.",
               .lonlat = true},
              {.name = "radius_m",
               .field = AT(light_clouds[i].radius_m),
               .range = {10, 1e6},
               .unit = "m",
               .meaning = "Its approximate radius."},
              {.name = "strength",
               .field = AT(light_clouds[i].strength),
               .range = {0, 1},
               .meaning = "Share of the sunlight that it blocks."},
              {.name = "blend_m",
               .field = AT(light_clouds[i].blend_m),
               .range = {0, 1e6},
               .unit = "m",
               .meaning = "Width of its soft edge. Default: its radius."},
          },
      .count = [](const Scene& s) { return s.light_clouds.size(); },
      .resize = [](Scene& s, std::size_t n) { s.light_clouds.resize(n); }};
}

}  // namespace

std::vector<SceneSection> make_light_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "light",
       .meaning = "How light becomes tone, which selects the palette's colours.",
       .keys = {
           {.name = "sun",
            .field = AT(light.sun),
            .range = {0, 2},
            .meaning = "Strength of sunlight."},
           {.name = "sky",
            .field = AT(light.sky),
            .range = {0, 2},
            .meaning = "Strength of light from the sky."},
           {.name = "relief",
            .field = AT(light.relief),
            .range = {0, 1},
            .meaning =
                "How much ridges are lightened and hollows darkened, independent of the sun."},
           {.name = "shadow_depth",
            .field = AT(light.shadow_depth),
            .range = {0, 1},
            .meaning = "Share of the sunlight that a cast shadow blocks."},
           {.name = "contrast",
            .field = AT(light.contrast),
            .range = {0.2, 3},
            .meaning = "Contrast between light and shade."},
           {.name = "model",
            .field = AT(light.model),
            .meaning = "How light becomes colour: ramp takes shade and light from the palette as "
                       "painters mix them; product multiplies the ground's own colour by the "
                       "light, like most relief shading, for comparison.",
            .text = TextKind::choice,
            .choices = {"ramp", "product"}},
       }});
  sections.push_back(make_light_region_section());
  sections.push_back(make_light_cloud_section());
  return sections;
}

}  // namespace belvedere
