#pragma once

#include <cstdint>
#include <vector>

namespace belvedere {

// Counter-based random numbers: a value is a pure function of its key, so it does not depend on
// threads, tiles or order. Mixing is the finalizer of MurmurHash3 (64 bit), applied to every word
// of the key.
constexpr std::uint64_t mix_bits(std::uint64_t z) {
  z ^= z >> 33;
  z *= 0xff51afd7ed558ccdULL;
  z ^= z >> 33;
  z *= 0xc4ceb9fe1a85ec53ULL;
  z ^= z >> 33;
  return z;
}

// Key: the seed of a stream (random_streams.h), two integer coordinates (pixel, cell or lattice
// point), draw number.
constexpr std::uint64_t random_bits(std::uint64_t seed, std::int64_t x, std::int64_t y,
                                    std::uint64_t draw = 0) {
  std::uint64_t h = mix_bits(seed + 0x9e3779b97f4a7c15ULL);
  h = mix_bits(h ^ (static_cast<std::uint64_t>(x) * 0xd6e8feb86659fd93ULL));
  h = mix_bits(h ^ (static_cast<std::uint64_t>(y) * 0xa0761d6478bd642fULL));
  return mix_bits(h ^ (draw * 0xe7037ed1a0b428dbULL));
}

// Uniform in [0, 1): 53 bits, exact in double, so the same on every machine.
constexpr double random_uniform(std::uint64_t seed, std::int64_t x, std::int64_t y,
                                std::uint64_t draw = 0) {
  return static_cast<double>(random_bits(seed, x, y, draw) >> 11) * 0x1.0p-53;
}

// Integer in [0, count), count > 0; the bias of the multiply-shift is below 2^-32.
constexpr std::uint32_t random_index(std::uint32_t count, std::uint64_t seed, std::int64_t x,
                                     std::int64_t y, std::uint64_t draw = 0) {
  return static_cast<std::uint32_t>(((random_bits(seed, x, y, draw) >> 32) * count) >> 32);
}

// Roughly normal, mean 0, deviation 1, bounded to ±3.46: the sum of four uniforms of 16 bits each
// (Irwin-Hall), scaled by sqrt(3). It uses no transcendental function, so it is bit-exact
// everywhere.
constexpr double random_normal(std::uint64_t seed, std::int64_t x, std::int64_t y,
                               std::uint64_t draw = 0) {
  const std::uint64_t b = random_bits(seed, x, y, draw);
  const double sum =
      static_cast<double>((b & 0xffff) + ((b >> 16) & 0xffff) + ((b >> 32) & 0xffff) + (b >> 48));
  return (sum * (1.0 / 65535.0) - 2.0) * 1.7320508075688772;
}

// The purposes of random numbers: each has a stream of its own, so that no two things in a picture
// are correlated by a shared key. Stream numbers are part of every picture: append new ones and
// never remove any.
enum class Stream : std::uint16_t {
  // Strokes, a stream for each kind (texture/strokes/stroke_table.cpp).
  sky,
  wash,
  forest_trees,
  forest_edges,
  glade_grass,
  meadow,
  scattered_trees,
  low_bushes,
  rock_trees,
  grass_flecks,
  rock_facets,
  rock_hatching,
  rock_ledges,
  rock_fissures,
  rock_snow,
  rock_rubble,
  rock_turf,
  rock_drifts,
  scree,
  snow,
  broken_colour,
  water,
  snow_ribs,
  glacier_flow_lines,
  glacier_edges,
  glacier_moraines,
  glacier_crevasses,
  houses,
  churches,
  farms,
  accents,
  // Noises that steer strokes: where they gather, how groups of them differ.
  church_centres,
  forest_masses,
  forest_groups,
  forest_edge_groups,
  leafy_groups,
  leaf_colours,
  tree_stretches,
  copses,
  meadow_patches,
  fleck_patches,
  rock_joints,
  rock_slants,
  ledge_places,
  bed_dips,
  bed_wavering,  // of beds of rock, for their light and their strokes alike
  bed_strengths,
  rock_snow_places,
  rock_tree_places,
  turf_places,
  drift_places,
  rubble_places,
  rib_places,
  torn_ice,
  street_directions,
  house_density,
  farm_density,
  // Fields of the valley floor.
  field_blocks,
  field_bends,
  field_kinds,
  field_borders,
  // The base picture and its light.
  ground_patches,
  water_streaks,
  light_pools,
  rib_lines,
  rib_strengths,
  rock_plane_edges,
  rock_plane_tilts,
  forest_lanes,
  forest_glades,
  forest_clumps,
  forest_tracks,
  forest_stands,
  cloud_banks,
  cloud_edges,
  cloud_veils,
  sky_bands,
  // Rays.
  sun_rays,
  // Land cover by rules.
  class_noise,
  towns,
  // Copying from paintings, and evaluation of copies.
  synthesis,
  patch_samples,
  // Example sheets.
  sheet_panels,
  sheet_terrains,
  // Synthetic terrain; its plan has numbers of its own (terrain/synthetic/synthetic_plan.h).
  ridged_terrain,
  // Added later: numbers are positions in this list.
  sand,
  sand_patches,
  layers_fit,  // cells that surface layers are fitted on, initial positions of clusters
  rock_spurs,
  rock_funnels,
  rock_bands,
  rock_warp,
  rock_beds,
  rock_lines,
  rock_calm,
  rock_cover,
  rock_diagonals,
  rock_dabs,
  rock_chips,
  ground_stones,
  stone_fields,
  grass_tufts,
  tuft_fields,
  snow_drifts,
  snow_cornices,
  sky_kind,
  statistical_dither,
  statistical_noise,
  statistical_discs,
  statistical_moves,
  statistical_directions,
  label_maps,
  feature_edges,  // roughness of lines of features
  water_wind,     // where wind ruffles lakes
  wind_streaks,
  river_foam,
  sea_surf,
  surf_breaks,  // gaps in the line of surf
  lake_ice,
  mist_layers,
  mist_billows,
  mist_patches,
  mist_dabs,
  mist_lights,
  lee_clouds,
  front_decks,
  cloud_shadows,
  style_fit,         // which strokes of a painting a style keeps
  style_sky,         // a painting's sky over the render
  style_directions,  // how its sky's strokes run
  style_strokes,     // a layer each
  style_contrasts,   // where it contrasts more than elsewhere
  style_weave,
  style_contours,  // dark strokes along silhouettes
  close_roofs,     // forms of snow, scree and grass seen from near
  close_borders,
  close_calm,  // where they are low
  river_banks,

  count  // not a stream: their number
};

// The seed of a stream in a picture whose seed is `seed`; `part` separates streams of one purpose:
// octaves, layers, panels. Neighbouring seeds are unrelated.
constexpr std::uint64_t stream_seed(std::uint64_t seed, Stream stream, std::uint64_t part = 0) {
  std::uint64_t h = mix_bits(seed + 0x9e3779b97f4a7c15ULL);
  h = mix_bits(h ^ ((static_cast<std::uint64_t>(stream) + 1) * 0xd6e8feb86659fd93ULL));
  return mix_bits(h ^ (part * 0xa0761d6478bd642fULL));
}

// Smooth noise over the plane, mean 0, standard deviation exactly 1 everywhere, a pure function of
// seed and position. It needs no grid and does not depend on resolution or tiles. It is white noise
// on a lattice under a cubic B-spline of spacing sigma·sqrt(3), whose standard deviation is sigma:
// close to white noise under a Gaussian of that sigma. x, y and sigma in the same unit (metres on
// the ground, or pixels).
double gaussian_noise(std::uint64_t seed, double x, double y, double sigma);

// The same with different widths along x and y.
double gaussian_noise(std::uint64_t seed, double x, double y, double sigma_x, double sigma_y);

// The part of gaussian_noise that depends only on the positions x + i · step, i < count. It is the
// same for every row and seed of a grid.
struct NoiseColumns {
  struct Column {
    int first;                 // lattice column of the first of four, from first_column on
    double weight[4];          // of the B-spline
    double inverse_deviation;  // 1 / sqrt(sum of their squares)
  };
  double spacing = 0.0;  // of the lattice
  std::int64_t first_column = 0;
  int lattice_columns = 0;
  std::vector<Column> columns;
};
// step > 0.
NoiseColumns plan_noise_columns(double x, double step, int count, double sigma);

// gaussian_noise at those positions of the row y, into out: equal up to rounding, and much cheaper
// if the step is no longer than sigma.
void gaussian_noise_row(const NoiseColumns& positions, std::uint64_t seed, double y, float* out);

}  // namespace belvedere
