#pragma once

#include <cstdint>

#include "base/random.h"

namespace belvedere {

// What random numbers are drawn for: each purpose has a stream of its own, so that no two things in a picture are alike by the accident
// of one key. A stream's number is part of every picture: a new one goes to the end, and none is taken out.
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
  // Noises that strokes are steered by: where they gather, how groups of them differ.
  church_middles,
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
  // Copying from paintings, and how copies are judged.
  synthesis,
  patch_samples,
  // Example sheets.
  sheet_panels,
  sheet_terrains,
  // Made-up terrain; its plan has numbers of its own (terrain/synthetic/synthetic_plan.h).
  ridged_terrain,
  // What came later: their numbers are their places.
  sand,
  sand_patches,
  layers_fit,  // which cells surface layers are fitted on, where clusters begin
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
  feature_edges,  // how unevenly lines of features are drawn
  water_wind,     // where wind ruffles lakes
  wind_streaks,
  river_foam,
  sea_surf,
  surf_breaks,  // where the line of surf is broken
  lake_ice,
  mist_layers,
  mist_billows,
  mist_patches,
  mist_dabs,
  mist_lights,
  lee_clouds,
  front_decks,
  cloud_shadows,

  count  // no stream: how many there are
};

// The seed of a stream in a picture whose seed is `seed`; `part` tells those of one purpose apart: octaves, layers, panels. Neighbouring
// seeds share nothing.
constexpr std::uint64_t stream_seed(std::uint64_t seed, Stream stream, std::uint64_t part = 0) {
  std::uint64_t h = mix_bits(seed + 0x9e3779b97f4a7c15ULL);
  h = mix_bits(h ^ ((static_cast<std::uint64_t>(stream) + 1) * 0xd6e8feb86659fd93ULL));
  return mix_bits(h ^ (part * 0xa0761d6478bd642fULL));
}

}  // namespace belvedere
