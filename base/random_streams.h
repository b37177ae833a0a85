#pragma once

#include <cstdint>

namespace belvedere {

// What random numbers are drawn for.
enum class Stream : std::uint64_t {
  sky = 1,
  wash = 2,
  forest_trees = 11,
  forest_edges = 25,
  glade_grass = 26,
  meadow = 3,
  scattered_trees = 12,
  low_bushes = 13,
  rock_trees = 42,
  grass_flecks = 27,
  rock_facets = 4,
  rock_hatching = 5,
  rock_ledges = 15,
  rock_fissures = 6,
  rock_snow = 20,
  rock_rubble = 41,
  rock_turf = 40,
  rock_drifts = 43,
  scree = 7,
  snow = 8,
  broken_colour = 21,
  water = 9,
  snow_ribs = 16,
  glacier_flow_lines = 17,
  glacier_edges = 19,
  glacier_moraines = 36,
  glacier_crevasses = 18,
  houses = 55,
  churches = 24,
  farms = 27,
  accents = 10,
};

}  // namespace belvedere
