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

std::vector<SceneSection> make_air_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "air",
       .meaning = "How distance changes colour.",
       .keys = {
           {.name = "haze",
            .field = AT(air.look.haze),
            .range = {0, 1},
            .meaning = "Largest share of haze, at the horizon."},
           {.name = "from_m",
            .field = AT(air.from_m),
            .range = {0, 1e7},
            .unit = "m",
            .meaning = "Distance at which haze begins.",
            .derived = "0.45 times the distance of the view's horizon"},
           {.name = "scale_m",
            .field = AT(air.scale_m),
            .range = {0, 1e7, true},
            .unit = "m",
            .meaning = "Distance over which haze grows to two thirds of its limit.",
            .derived = "0.6 times the distance of the horizon"},
           {.name = "range_mist",
            .field = AT(air.look.range_mist),
            .range = {0, 3},
            .meaning = "Strength of the mist between ranges, which sets them apart."},
           {.name = "warm_near",
            .field = AT(air.look.warm_near),
            .range = {0, 3},
            .meaning = "Warmth of the foreground's colours."},
           {.name = "hue_drift",
            .field = AT(air.look.hue_drift),
            .range = {0, 3},
            .meaning = "Slow change of hue across fields, forest and rock."},
           {.name = "rim_fade_m",
            .field = AT(air.rim_fade_m),
            .range = {0, 1e6},
            .meaning =
                "Over this distance before the edge of the terrain, haze increases and mountains "
                "become blue silhouettes, so that the terrain does not end in a cliff. "
                "Mountains far above the whole region keep their colour. 0: off.",
            .derived = "0.035 times the distance of the horizon"},
           {.name = "clouds",
            .field = AT(air.look.clouds),
            .range = {0, 2},
            .meaning = "Amount of clouds; 0 is a clear sky."},
           {.name = "sky",
            .field = AT(sky),
            .meaning =
                "Kind of clouds. fair: scattered cumulus. rows: streets of small cumulus that "
                "converge behind the horizon. streaks: high cirrus, all leaning the same way. "
                "banks: a wall of cloud behind the ranges. any: one of these, chosen by seed and "
                "view. By weather: cumulus, tall cumulus in streets; front, a cloud deck that "
                "moves in from one side; evening, long bars lit from below.",
            .text = TextKind::choice,
            .choices = {"any", "fair", "rows", "streaks", "banks", "cumulus", "front", "evening"}},
       }});
  sections.push_back(
      {.name = "air.mist",
       .kind = SectionKind::list,
       .meaning = "One block for each mist; see weather.md. It lies on the true ground and is "
                  "raised and bent with it.",
       .keys =
           {
               {.name = "name", .field = AT(air.mist[i].name), .meaning = "Name for messages."},
               {.name = "kind",
                .field = AT(air.mist[i].kind),
                .meaning =
                    "sea: fog up to an altitude, from which summits emerge as islands. valley: "
                    "thin banks on valley floors. lee: a cloud at a summit, drawn out by the wind.",
                .text = TextKind::choice,
                .choices = {"sea", "valley", "lee"}},
               {.name = "to_m",
                .field = AT(air.mist[i].to_m),
                .range = {-500, 9000},
                .unit = "m",
                .meaning = "For sea (required): altitude of its surface."},
               {.name = "height_m",
                .field = AT(air.mist[i].look.height_m),
                .range = {5, 2000},
                .unit = "m",
                .meaning = "For valley: its height above the valley floors."},
               {.name = "visibility_m",
                .field = AT(air.mist[i].visibility_m),
                .range = {20, 1e5},
                .unit = "m",
                .meaning = "Visibility in it. Default: 450 in a sea, 500 in valleys."},
               {.name = "edge_m",
                .field = AT(air.mist[i].look.edge_m),
                .range = {0, 1000},
                .unit = "m",
                .meaning = "Depth below its surface over which its density grows: larger gives "
                           "softer edges on slopes."},
               {.name = "billows",
                .field = AT(air.mist[i].look.billows),
                .range = {0, 3},
                .meaning = "Height of the billows of its surface; 0 is flat."},
               {.name = "patches",
                .field = AT(air.mist[i].patches),
                .range = {0, 1},
                .meaning = "Gaps: 0 closed, 1 a few banks. Default: 0 for a sea, 0.35 in valleys."},
               {.name = "position",
                .field = AT(air.mist[i].position),
                .range = {-largest_m, largest_m},
                .unit = "m",
                .meaning = "Its centre, or the summit of a lee cloud, [E, N] in the scene's CRS."},
               {.name = "position_lonlat",
                .field = AT(air.mist[i].position_lonlat),
                .unit = "°",
                .meaning = "The same, [longitude, latitude]; instead of position.",
                .lonlat = true},
               {.name = "radius_m",
                .field = AT(air.mist[i].look.radius_m),
                .range = {0, 1e6},
                .unit = "m",
                .meaning = "For sea or valley: its radius around the position; 0: unlimited."},
               {.name = "size_m",
                .field = AT(air.mist[i].look.size_m),
                .range = {50, 1e5},
                .unit = "m",
                .meaning = "For lee: its length."},
               {.name = "wind_from_deg",
                .field = AT(air.mist[i].look.wind_from_deg),
                .range = {-360, 360},
                .unit = "°",
                .meaning = "For lee: direction the wind comes from, clockwise from north."},
           },
       .count = [](const Scene& s) { return s.air.mist.size(); },
       .resize = [](Scene& s, std::size_t n) { s.air.mist.resize(n); }});
  return sections;
}

}  // namespace belvedere
