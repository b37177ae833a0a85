#pragma once

#include <cstddef>
#include <cstdint>

#include "base/random.h"

// Noise for synthetic terrain; a pure function of seed and position, so it does not depend on grid,
// tiles or threads.

namespace belvedere::synthetic {

// Purposes of noise, as a number added to the plan's seed, which is hashed from the scene's;
// octaves take the following numbers. The numbers must not change: terrains and views of the
// example sheet and of the demo were chosen for their results.
enum class TerrainNoise : std::uint64_t {
  valley_bends = 11,
  valley_wavering = 12,
  valley_widths = 13,
  range_bends_east = 20,
  range_bends_south = 30,
  massifs = 40,
  ranges = 50,
  soft_rock = 60,
  soft_patches = 70,
  roughness_bends_east = 81,
  roughness_bends_south = 82,
  roughness = 83,
  first_relief = 90,
  slope_ribs = 91,
  broad_slope_ribs = 92,
  floor_widths = 101,
  cirques = 102,
  moraines = 103,
  aprons = 104,
  river_bends = 200,
};
constexpr std::uint64_t noise_seed(std::uint64_t plan_seed, TerrainNoise noise) {
  return plan_seed + static_cast<std::uint64_t>(noise);
}

// Draw numbers of values drawn once per position: a valley, an outlet, a dam.
enum class TerrainDraw : std::uint64_t {
  valley_direction = 1,
  valley_place = 2,
  outlet_place = 5,
  outlet_level = 6,
  dam_order = 31,
  dam_size = 32,
  dam_share = 33
};
constexpr double draw_uniform(std::uint64_t plan_seed, std::int64_t x, std::int64_t y,
                              TerrainDraw draw) {
  return random_uniform(plan_seed, x, y, static_cast<std::uint64_t>(draw));
}
constexpr std::uint64_t draw_bits(std::uint64_t plan_seed, std::int64_t x, std::int64_t y,
                                  TerrainDraw draw) {
  return random_bits(plan_seed, x, y, static_cast<std::uint64_t>(draw));
}

// The plan of a landscape: uplift and main valleys. Positions in metres from the padded map's
// north-west corner, x east, y south; `unit_m` scales it down for maps smaller than a mountain
// range.
class Plan {
 public:
  Plan(double height_m, double unit_m, std::uint64_t seed);

  int valleys() const { return valleys_; }
  bool flows_east(int valley) const;
  // The centreline of a main valley, y at x.
  double valley_y(int valley, double x) const;
  // Uplift rate, 0…about 1.5.
  float uplift(double x, double y) const;
  // Softness of the rock, about 0.4…2.
  float softness(double x, double y) const;

  std::uint64_t seed() const { return seed_; }
  double unit_m() const { return unit_m_; }

 private:
  double height_m_;
  double unit_m_;
  std::uint64_t seed_;
  int valleys_ = 1;
};

// Cells are stored as 32-bit indices, which halves their memory; a grid is indexed with
// std::size_t.
inline std::size_t at(std::int32_t cell) { return static_cast<std::size_t>(cell); }

// Gradient noise (Perlin 2002) with one lattice point per unit, mean 0, about -1…1.
float gradient_noise(std::uint64_t seed, double x, double y);
// A sum of `octaves` of it, each with half the length and `gain` times the amplitude of the
// previous, divided by the sum of the amplitudes.
float fractal_noise(std::uint64_t seed, double x, double y, int octaves, float gain = 0.5F);
// Ridged multifractal (Musgrave 1998), 0…1: crests at 1, and more detail on crests than in hollows.
float ridged_noise(std::uint64_t seed, double x, double y, int octaves, float gain = 0.5F);

}  // namespace belvedere::synthetic
