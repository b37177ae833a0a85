#include "renderer/scene/scene_table.h"

namespace belvedere {

std::vector<SceneSection> make_climate_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "climate",
       .meaning = "How warm it is and how much falls, by place and altitude: from stations, else from rasters, else from what is known of "
                  "the place; see climate.md. `belvedere check` says which it was and how sure that is.",
       .keys = {
           {.name = "stations",
            .field = AT(climate.stations),
            .meaning =
                "Weather stations: a table (.csv, .gpkg, .geojson …) with places, altitude_m, t_1 … t_12 or t_year in °C, rain_mm; or "
                "a history of the climate (.nc).",
            .text = TextKind::file},
           {.name = "temperature",
            .field = AT(climate.temperature),
            .meaning = "Raster of 12 bands: means of January … December, in °C or kelvin (WorldClim, CHELSA).",
            .text = TextKind::file,
            .raster = true},
           {.name = "temperature_factor",
            .field = AT(climate.temperature_factor),
            .range = {0.001, 1000},
            .meaning = "°C or kelvin for each unit of that raster: 0.1 where it holds tenths."},
           {.name = "rain",
            .field = AT(climate.rain),
            .meaning = "Raster of rain and snow, mm: 12 bands of months, or one of the year.",
            .text = TextKind::file,
            .raster = true},
           {.name = "lapse_k_per_km",
            .field = AT(climate.lapse_k_per_km),
            .range = {-5, 12},
            .unit = "K/km",
            .meaning = "How much colder it is 1 km higher, in all months; without it as stations, raster or place say."},
           {.name = "wind_from_deg",
            .field = AT(climate.wind_from_deg),
            .range = {0, 360},
            .unit = "°",
            .meaning =
                "Where the wind that brings rain comes from, clockwise from north: more falls on that side of mountains, less on the "
                "other. Without it as is usual at the latitude, on maps of 40 km or more and where stations know their rain."},
           {.name = "latitude_deg",
            .field = AT(climate.latitude_deg),
            .range = {-90, 90},
            .unit = "°",
            .meaning = "Latitude of a terrain that has no coordinate system, or is made up."},
       }});
  return sections;
}

}  // namespace belvedere
