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

}  // namespace belvedere
