#pragma once

#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/climate/map_position.h"
#include "terrain/climate/rain.h"
#include "terrain/climate/zonal_climate.h"
#include "terrain/io/dem.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// Used if nothing better is known: longitude and latitude in degrees.
using DefaultClimate = std::function<PlaceClimate(glm::dvec2 lonlat_deg)>;

struct ClimateParameters {
  std::string stations = {};  // a file as in terrain/climate/stations.h; empty: none
  std::optional<RasterSource> temperature =
      {};  // 12 bands of monthly means, °C, or K if their median is above 150
  double temperature_factor = 1.0;  // 0.001…1000: °C (or K) per unit of the raster; .1 for tenths
  std::optional<RasterSource> rain = {};  // 12 bands of months, or one of the year, mm
  double rain_factor = 1.0;               // 0.05…20: on the rain of any source
  // 0…1: how far the ground lies behind ranges or far from the sea, where the built-in tables do
  // not know it; see sheltered_climate. Rain of stations or rasters stays as it is.
  double sheltered = 0.0;
  // Another time, relative to all of these: an ice age, or a warmer century.
  double warmer_k = 0.0;  // -30…30, in all months
  double wetter = 0.0;    // -0.95…10: share of the rain that falls in addition
  std::optional<double> lapse_k_per_km =
      {};  // -5…12: overrides stations, raster and default for all months
  std::optional<double> wind_from_deg =
      {};  // 0…360, true: direction the rain-bearing wind comes from; else by latitude
  std::optional<double> latitude_deg = {};  // of a map without CRS
  UpslopeParameters upslope = {};           // its wind is taken from above
};

// The climate of a map as a compact function of position and altitude: columns at nodes some 50 km
// apart, and corrections from rasters and wind on a grid of about a kilometre.
struct Climate {
  MapPosition position;
  Grid<PlaceClimate> nodes;              // at the map's corners and evenly between
  int coarse_cells = 1;                  // cells of the map on a side of a cell of the grids below
  std::array<Grid<float>, 12> warmer_k;  // correction by a raster, per month; empty without
  Grid<float> rain_share;                // factor on the column's rain, ≥ 0; empty: 1
  double wind_from_deg = 270.0;          // true
  std::vector<std::string> sources;  // the sources and their accuracy, one line each, for reports

  // At a position in cells of the map, which may be fractional.
  PlaceClimate at(double column, double row) const;
  // A grid of about a kilometre at such a position.
  double on_coarse_grid(const Grid<float>& grid, double column, double row) const;
};

// Uses the best source for temperature and for rain: stations, else a raster, else the default.
// Wind redistributes rain (upslope_rain) if the scene names a wind, if there are stations, or if
// the map is 40 km wide or high; smaller maps are too small for it. It never acts a second time on
// rain that was measured in a lee: the fit to stations takes it into account, or does without it
// where that meets them better; in dry places it fades (PlaceClimate::sheltered); on rasters it
// does not act. Also reports its sources as notes. Throws as read_stations and the readers of
// rasters do; Error(usage) for values out of range.
Climate make_climate(const Dem& dem, const ClimateParameters& parameters,
                     const DefaultClimate& fallback, Progress& progress);

// Usual direction of the rain-bearing wind, true degrees: trade winds up to 30° of latitude,
// westerlies to 65°, then easterlies.
double usual_wind_from_deg(double latitude_deg);

}  // namespace belvedere
