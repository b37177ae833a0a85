#pragma once

#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/climate/map_place.h"
#include "terrain/climate/rain.h"
#include "terrain/climate/zonal_climate.h"
#include "terrain/io/dem.h"
#include "terrain/io/raster_source.h"

namespace belvedere {

// What is taken where nothing better is known: longitude and latitude in degrees.
using DefaultClimate = std::function<PlaceClimate(glm::dvec2 lonlat_deg)>;

struct ClimateParameters {
  std::string stations = {};                     // a file of terrain/climate/stations.h; empty: none
  std::optional<RasterSource> temperature = {};  // 12 bands of monthly means, °C, or K where their median is above 150
  double temperature_factor = 1.0;               // 0.001…1000: °C (or K) a unit of the raster; .1 for tenths
  std::optional<RasterSource> rain = {};         // 12 bands of months, or one of the year, mm
  std::optional<double> lapse_k_per_km = {};     // -5…12: instead of what stations, raster or default say, for all months
  std::optional<double> wind_from_deg = {};      // 0…360, true, where wind brings rain from; else by latitude
  std::optional<double> latitude_deg = {};       // of a map without CRS
  UpslopeParameters upslope = {};                // its wind comes from above
};

// The climate of a map, as a function of place and altitude that takes little room: columns at nodes some 50 km apart, and on a grid of
// about a kilometre what rasters and wind say besides.
struct Climate {
  MapPlace place;
  Grid<PlaceClimate> nodes;              // at the map's corners and evenly between
  int coarse_cells = 1;                  // cells of the map on a side of a cell of the grids below
  std::array<Grid<float>, 12> warmer_k;  // that months are, by a raster; empty without
  Grid<float> rain_share;                // of the column's rain, ≥ 0; empty: 1
  double wind_from_deg = 270.0;          // true
  std::vector<std::string> sources;      // what it was made from and how sure that is, a line each, for people

  // At a place in cells of the map, which need not be whole.
  PlaceClimate at(double column, double row) const;
};

// From the best source there is, for temperature and for rain each: stations, else a raster, else the default. Rain is shared out by wind
// (upslope_rain) where the scene names a wind, where there are stations, or where the map is 40 km wide or high; it learns nothing on
// smaller ones. Tells its sources as notes as well. Throws what read_stations and the readers of rasters throw; Error(usage) for ranges.
Climate make_climate(const Dem& dem, const ClimateParameters& parameters, const DefaultClimate& fallback, Progress& progress);

// Where the wind that brings rain mostly comes from, true degrees: trade winds up to 30° of latitude, westerlies to 65°, then easterlies.
double usual_wind_from_deg(double latitude_deg);

}  // namespace belvedere
