#include "renderer/scene/scene_table.h"

namespace belvedere {

std::vector<SceneSection> make_air_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "air",
       .meaning = "What distance does to colour.",
       .keys = {
           {.name = "haze", .field = AT(air.look.haze), .range = {0, 1}, .meaning = "Greatest share of haze at the horizon."},
           {.name = "from_m",
            .field = AT(air.from_m),
            .range = {0, 1e7},
            .unit = "m",
            .meaning = "Distance at which haze begins.",
            .derived = ".45 of the distance of the view's horizon"},
           {.name = "scale_m",
            .field = AT(air.scale_m),
            .range = {0, 1e7, true},
            .unit = "m",
            .meaning = "Distance over which it thickens to two thirds.",
            .derived = ".6 of the distance of the horizon"},
           {.name = "range_mist",
            .field = AT(air.look.range_mist),
            .range = {0, 3},
            .meaning = "Mist between ranges that sets them apart."},
           {.name = "warm_near", .field = AT(air.look.warm_near), .range = {0, 3}, .meaning = "Warmth of the foreground's colours."},
           {.name = "hue_drift",
            .field = AT(air.look.hue_drift),
            .range = {0, 3},
            .meaning = "Slow change of hue across fields, forest and rock."},
           {.name = "rim_fade_m",
            .field = AT(air.rim_fade_m),
            .range = {0, 1e6},
            .meaning =
                "Over this distance the terrain stands ever deeper in haze towards its end, mountains as blue silhouettes, so that it "
                "does not end in a cliff; 0 is off.",
            .derived = ".035 of the distance of the horizon"},
           {.name = "clouds", .field = AT(air.look.clouds), .range = {0, 2}, .meaning = "How many clouds; 0 is a clear sky."},
           {.name = "sky",
            .field = AT(sky),
            .meaning =
                "What clouds there are. fair: heaps here and there. rows: streets of small heaps that come from one place behind the "
                "horizon. streaks: ice high up, that leans one way. banks: a wall of cloud behind the ranges. any: one of these, by seed "
                "and view. By weather: cumulus, high heaps in streets; front, a deck that draws up from one side; evening, long bars lit "
                "from below.",
            .text = TextKind::choice,
            .choices = {"any", "fair", "rows", "streaks", "banks", "cumulus", "front", "evening"}},
       }});
  sections.push_back(
      {.name = "air.mist",
       .kind = SectionKind::list,
       .meaning = "One block for each mist; see weather.md. It lies on the true ground and follows it where that is raised and bent.",
       .keys =
           {
               {.name = "name", .field = AT(air.mist[i].name), .meaning = "For messages."},
               {.name = "kind",
                .field = AT(air.mist[i].kind),
                .meaning = "sea: fog up to an altitude, summits stand out of it as islands. valley: thin banks on the floors of valleys. "
                           "lee: a cloud that hangs on a summit, drawn out by the wind.",
                .text = TextKind::choice,
                .choices = {"sea", "valley", "lee"}},
               {.name = "to_m",
                .field = AT(air.mist[i].to_m),
                .range = {-500, 9000},
                .unit = "m",
                .meaning = "Of a sea: altitude of its surface. A sea has to say it."},
               {.name = "height_m",
                .field = AT(air.mist[i].look.height_m),
                .range = {5, 2000},
                .unit = "m",
                .meaning = "In valleys: how high it stands over their floors."},
               {.name = "sight_m",
                .field = AT(air.mist[i].sight_m),
                .range = {20, 1e5},
                .unit = "m",
                .meaning = "How far one sees in it; where nothing is said, 450 in a sea, 500 in valleys."},
               {.name = "edge_m",
                .field = AT(air.mist[i].look.edge_m),
                .range = {0, 1000},
                .unit = "m",
                .meaning = "Height below its surface over which it grows dense: how softly it laps slopes."},
               {.name = "billows",
                .field = AT(air.mist[i].look.billows),
                .range = {0, 3},
                .meaning = "How high its surface heaps; 0 is flat."},
               {.name = "patches",
                .field = AT(air.mist[i].patches),
                .range = {0, 1},
                .meaning = "How torn it is: 0 closed, 1 a few banks; where nothing is said, 0 for a sea, .35 in valleys."},
               {.name = "position",
                .field = AT(air.mist[i].position),
                .range = {-largest_m, largest_m},
                .unit = "m",
                .meaning = "Its middle, or the summit of a lee cloud, [E, N] in the scene's CRS."},
               {.name = "position_lonlat",
                .field = AT(air.mist[i].position_lonlat),
                .unit = "°",
                .meaning = "The same, [longitude, latitude]; instead of position.",
                .lonlat = true},
               {.name = "radius_m",
                .field = AT(air.mist[i].look.radius_m),
                .range = {0, 1e6},
                .unit = "m",
                .meaning = "Of a sea or in valleys: it ends so far from its position; 0: it has no end."},
               {.name = "size_m",
                .field = AT(air.mist[i].look.size_m),
                .range = {50, 1e5},
                .unit = "m",
                .meaning = "Of a lee cloud: how long it is."},
               {.name = "wind_from_deg",
                .field = AT(air.mist[i].look.wind_from_deg),
                .range = {-360, 360},
                .unit = "°",
                .meaning = "Of a lee cloud: where the wind comes from, clockwise from north."},
           },
       .count = [](const Scene& s) { return s.air.mist.size(); },
       .resize = [](Scene& s, std::size_t n) { s.air.mist.resize(n); }});
  return sections;
}

}  // namespace belvedere
