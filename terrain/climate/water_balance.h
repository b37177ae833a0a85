#pragma once

#include "terrain/climate/zonal_climate.h"

namespace belvedere {

struct WaterBalanceParameters {
  double soil_mm = 120.0;  // plant-available water capacity of the soil, 10…500
  double mm_per_kelvin =
      65.0;  // potential evapotranspiration of a year per °C of the mean of months clamped to 0…30
             // °C; 30…120. Holdridge (1967, Life zone ecology) has 58.93, Thornthwaite's formula 65
             // in middle latitudes (Vienna 650 mm, Budapest 710)
  double sublimation_mm = 20.0;  // of fresh snow in a month below 0 °C, by dry air of 1; 0…50
};

// The water that plants could use in a year at an altitude, mm. Dry air (PlaceClimate::dry_air)
// takes more: in proportion to the monthly mean above -3 °C, because days under a clear sky are
// warmer than the mean.
double plant_water_demand_mm(const PlaceClimate& climate, double altitude_m,
                             const WaterBalanceParameters& parameters = {});

// Ratio of actual to potential evapotranspiration: 1 in the Alps, .7 where closed forest gives way
// to steppe (Budapest), .6 chaparral, .5 steppe (Madrid), .2 desert (St. George, Utah). A monthly
// bucket model (Thornthwaite & Mather 1955, The water balance): precipitation below 0 °C is stored
// as snow until the next month above it, and water beyond the soil's capacity runs off. 1 where it
// is too cold for plants.
double plant_water_share(const PlaceClimate& climate, double altitude_m,
                         const WaterBalanceParameters& parameters = {});

// Where snow is perennial, and where it lies on a day of the year.

struct SnowParameters {
  // Hollows in which glaciers form collect drifting snow and avalanches: factor on the snowfall of
  // level ground (1 … 4). 1 is open ground, below 1 are ribs and isolated cones swept by the wind.
  // 2 is fitted to published equilibrium lines; see docs/life_zones.md.
  double gathering = 2.0;
  double warmer_k = 0.0;  // added to all months, for example for radiation
};

// Snowfall of each month, mm of water: all precipitation below -1 °C, none above 3 °C, linear
// between (monthly means).
Months monthly_snow_mm(const PlaceClimate& climate, double altitude_m, double warmer_k = 0.0);

// Annual accumulation needed for snow to persist, mm of water: 645 + 296 T + 9 T², T the mean of
// the three warmest months (Ohmura, Kasser & Funk 1992, Climate at the equilibrium line of
// glaciers, Journal of Glaciology 38). That holds for summers of three or four months. Towards the
// equator melting goes on all year: the part due to T above 0 °C counts up to four times, as the
// annual mean comes within 6 K of the summer's. Small below T = -16.4 °C, the vertex of the
// parabola.
double snow_to_last_mm(const Months& months);

// Annual accumulation minus the amount needed for snow to persist, mm of water; < 0: it melts away.
double snow_balance_mm(const PlaceClimate& climate, double altitude_m,
                       const SnowParameters& parameters = {});

// The lowest altitude from which snow is perennial all the way up to 9000 m (the equilibrium line
// of glaciers), m; -2000 if everywhere, 9000 if nowhere.
double snow_line_m(const PlaceClimate& climate, const SnowParameters& parameters = {});

struct MeltParameters {
  double melt_mm_per_k_day =
      4.5;  // melt factor of snow; 3 … 6 are measured (Hock 2003, Journal of Hydrology 282)
  double weather_k = 4.0;  // > 0: deviation of days from the mean; lets some snow melt below 0 °C
};
// Snow on a day of the year (0…364, 0 is 1 January), mm of water: accumulated and melted day by day
// from the end of the warmest season on. Snow that lasts longer counts for one year only.
double snow_cover_mm(const PlaceClimate& climate, double altitude_m, int day,
                     const SnowParameters& snow = {1.0, 0.0}, const MeltParameters& melt = {});
// Altitude at which half of the ground is snow-covered on a day: the lowest above which there are
// at least 20 mm of water, m, -2000…9000.
double snow_line_of_day_m(const PlaceClimate& climate, int day,
                          const SnowParameters& snow = {1.0, 0.0}, const MeltParameters& melt = {});

}  // namespace belvedere
