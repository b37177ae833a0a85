#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/io/features.h"
#include "terrain/io/raster.h"

namespace belvedere {

// Inferred settlements: on valley floors, at the mouths of side valleys, beside rivers but not in
// them, low and with space around; on wide plains along rivers and edges; hamlets on sunny terraces
// near a floor. They are estimates, therefore fewer and smaller than on a map, and there are none
// where the land is unsuitable for agriculture.
struct TownSite {
  glm::dvec2 position{0.0};  // scene CRS, m
  double radius_m = 0.0;     // half the width across the street
  double stretch = 1.0;      // length along the street over the width, 1…3
  double along_rad = 0.0;    // the street's direction, counterclockwise from east
  bool on_floor = true;      // else a hamlet on a slope
};

struct KnownTown {
  glm::dvec2 position{0.0};  // scene CRS, m
  double radius_m =
      0.0;  // of a circle with the area of the town, up to largest_town_radius_m; 0: none
  std::string name = {};  // for messages
};
inline constexpr double largest_town_radius_m = 50000.0;  // larger than any city

struct TownParameters {
  double amount = 0.0;    // -1 only known ones, 0 some, 1 maximum density
  double inferred = 0.0;  // 0…1: inferred settlements are few and small … as many and as large as
                          // in the Alps, also on plains
  double highest_m = 1300.0;  // altitude limit of settlements
  std::uint64_t seed = 1;
  std::vector<KnownTown> known;
};

// Grids from which sites are evaluated; all of one size.
struct TownGround {
  const Grid<float>& altitude_m;
  const Grid<float>& floor;          // 0…1, membership of valley floors
  const Grid<float>& catchment_km2;  // grows strictly downstream
  const Grid<float>& slope_deg;
  const Grid<float>& south;  // exposure, 1 faces south
  const GeoTransform& transform;
  const Grid<float>* suitability = nullptr;  // agricultural suitability, 0…1; null: 1 everywhere
};

// Agricultural suitability, 0…1, from the ratio of available water to the demand of plants, 0…1,
// and the annual mean temperature, °C: 0 in steppe and desert, and where hardly anything ripens.
float agricultural_suitability(float moisture, float temperature_c);

// The sites, known ones first, then by quality; a known town keeps others at a distance. They
// depend on the whole map: a part of it may have other sites.
std::vector<TownSite> find_town_sites(const TownGround& ground, const TownParameters& parameters);

// Depth of each cell in a town: 1 at its centre, 0 at its edge, down to -4 four radii outside.
// Linked towns extend along the road between them.
Grid<float> town_field(const std::vector<TownSite>& sites, const TownGround& ground);

// Radius of a circle with the area of a town of that population: √(population · 170 m² / π). 170 m²
// of built-up ground per person is the mean of the eight towns that scenes/karwendel.toml has by
// radius, from 100 (Mittenwald) to 220 (Hall in Tirol).
double town_radius_m(double population);

// Towns from a table of points (terrain/io/points.h) with columns name, and radius_m or population;
// radius_m takes precedence. `crs`: the scene's. Rows with neither, or 0, are left out, with a note
// of their number. Throws Error(usage) if both columns are missing, and for sizes that are not
// numbers or beyond largest_town_radius_m; else as read_points does.
std::vector<KnownTown> read_towns(const VectorSource& source, const std::string& crs,
                                  Progress& progress);

}  // namespace belvedere
