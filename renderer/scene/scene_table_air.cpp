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
            .derived = ".9 of the distance of the horizon"},
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
                "horizon. streaks: ice high up, from such a place. banks: a wall of cloud behind the ranges. any: one of these, by seed "
                "and view.",
            .text = TextKind::choice,
            .choices = {"any", "fair", "rows", "streaks", "banks"}},
       }});
  return sections;
}

}  // namespace belvedere
