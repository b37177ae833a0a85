#pragma once

#include "terrain/climate/zonal_climate.h"

namespace belvedere {

struct WaterBalanceParameters {
  double soil_mm = 120.0;  // water that the soil holds for plants, 10…500
  double mm_per_kelvin =
      65.0;  // what plants could evaporate in a year, by the mean of months held within 0…30 °C; 30…120. Holdridge (1967,
             // Life zone ecology) has 58.93, Thornthwaite's formula 65 in middle latitudes (Vienna 650 mm, Budapest 710)
};

// Share of the water that plants could evaporate in a year which they get: 1 in the Alps, .7 where closed forest ends towards the steppe
// (Budapest), .6 chaparral, .5 steppe (Madrid), .2 desert (St. George, Utah). A bucket by months (Thornthwaite & Mather 1955, The water
// balance): what falls below 0 °C waits as snow for the next month above it, what the soil cannot hold runs off. 1 where nothing grows for
// cold.
double plant_water_share(const PlaceClimate& climate, double altitude_m, const WaterBalanceParameters& parameters = {});

}  // namespace belvedere
