#include "renderer/scene/scene_table.h"

namespace belvedere {

std::vector<SceneSection> make_climate_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "climate",
       .meaning = "Temperature and precipitation by position and altitude: from stations, else "
                  "from rasters, else from built-in values for the place; see climate.md. "
                  "`belvedere check` reports which was used and how certain it is.",
       .keys = {
           {.name = "stations",
            .field = AT(climate.stations),
            .meaning =
                "Weather stations: a table (.csv, .gpkg, .geojson …) with positions, altitude_m, "
                "t_1 … t_12 or t_year in °C, rain_mm; or a history of the climate (.nc).",
            .text = TextKind::file},
           {.name = "temperature",
            .field = AT(climate.temperature),
            .meaning = "Raster of 12 bands: means of January … December, in °C or kelvin "
                       "(WorldClim, CHELSA).",
            .text = TextKind::file,
            .raster = true},
           {.name = "temperature_factor",
            .field = AT(climate.temperature_factor),
            .range = {0.001, 1000},
            .meaning = "°C or kelvin per unit of that raster: 0.1 where it holds tenths."},
           {.name = "rain",
            .field = AT(climate.rain),
            .meaning = "Raster of precipitation (rain and snow), mm: 12 bands of months, or one "
                       "band of the year.",
            .text = TextKind::file,
            .raster = true},
           {.name = "rain_factor",
            .field = AT(climate.rain_factor),
            .range = {0.05, 20},
            .meaning = "Factor on the rain of any source: 0.5 for ground half as wet, with more "
                       "steppe and less forest."},
           {.name = "lapse_k_per_km",
            .field = AT(climate.lapse_k_per_km),
            .range = {-5, 12},
            .unit = "K/km",
            .meaning = "Decrease of temperature per km of altitude, in all months. Default: from "
                       "stations, raster or place."},
           {.name = "wind_from_deg",
            .field = AT(climate.wind_from_deg),
            .range = {0, 360},
            .unit = "°",
            .meaning = "Direction that rain-bearing wind comes from, clockwise from north: that "
                       "side of mountains gets more precipitation, the other less. Default: the "
                       "usual direction at the latitude, on maps of 40 km or more and where the "
                       "stations give precipitation."},
           {.name = "latitude_deg",
            .field = AT(climate.latitude_deg),
            .range = {-90, 90},
            .unit = "°",
            .meaning = "Latitude of a terrain that has no coordinate system or is synthetic."},
       }});
  return sections;
}

}  // namespace belvedere
