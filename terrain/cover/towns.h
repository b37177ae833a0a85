#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/grid.h"
#include "terrain/io/raster.h"

namespace belvedere {

// Where people may have settled: on the floors of valleys, where a side valley opens, beside the river and clear of it, low down and with
// room around; on wide plains along rivers and edges; hamlets on sunny terraces near a floor. These are guesses, so they are fewer and
// smaller than what a map would show, and there are none where the land feeds nobody.
struct TownSite {
  glm::dvec2 place{0.0};   // scene CRS, m
  double radius_m = 0.0;   // half the width across the street
  double stretch = 1.0;    // length along the street over the width, 1…3
  double along_rad = 0.0;  // the street's direction, counterclockwise from east
  bool on_floor = true;    // else a hamlet on a slope
};

struct KnownTown {
  glm::dvec2 place{0.0};  // scene CRS, m
  double radius_m = 0.0;  // of a circle as large as the built-up area, up to largest_town_radius_m; 0: none
  std::string name = {};  // for messages
};
inline constexpr double largest_town_radius_m = 50000.0;  // larger than any city

struct TownParameters {
  double amount = 0.0;        // -1 none but those known, 0 some, 1 as dense as it gets
  double guesses = 0.0;       // 0…1: places that nobody named are few and small, or as many and as large as in the Alps, plains and all
  double highest_m = 1300.0;  // nobody lives higher
  std::uint64_t seed = 1;
  std::vector<KnownTown> known;
};

// What sites are judged by; all of one size.
struct TownGround {
  const Grid<float>& altitude_m;
  const Grid<float>& floor;          // 0…1, membership of valley floors
  const Grid<float>& catchment_km2;  // grows strictly downstream
  const Grid<float>& slope_deg;
  const Grid<float>& south;  // exposure, 1 faces south
  const GeoTransform& transform;
  const Grid<float>* living = nullptr;  // 0…1, how surely people can live of the land; null: everywhere
};

// How surely people live of the land, 0…1, by the share of the water that plants could use which they get, 0…1, and the mean temperature of
// the year, °C: not in steppe and desert, and not where hardly anything ripens.
float living_of_land(float moisture, float temperature_c);

// The sites, known ones first, then the best place first; a known town keeps others at a distance. They depend on the whole map: a part of
// it may settle elsewhere.
std::vector<TownSite> find_town_sites(const TownGround& ground, const TownParameters& parameters);

// How deep each cell lies in a town: 1 in its middle, 0 at its edge, down to -4 four radii outside. Towns that are linked by an open way
// reach out along it.
Grid<float> town_field(const std::vector<TownSite>& sites, const TownGround& ground);

}  // namespace belvedere
