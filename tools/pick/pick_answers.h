#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/text/json.h"
#include "renderer/register/pair_proposals.h"
#include "terrain/io/dem.h"
#include "tools/pick/pairs_fitter.h"
#include "tools/web/tile_pyramid.h"

namespace belvedere::tools {

// What the page that picks pairs is answered, as JSON: docs/registration.md describes the members.

// What stays the same: the painting, the map and the known places.
struct PickingSetup {
  std::string painting;
  TilePyramid painting_tiles;
  TilePyramid map_tiles;
  glm::dvec2 map_origin{0.0};  // CRS, outer corner of its top-left pixel
  glm::dvec2 map_px_m{1.0};    // side of its pixels
  std::string crs;             // in words
  std::vector<KnownPlace> places;
  std::string next;
};
Json setup_json(const PickingSetup& setup);

Json pairs_json(const PairsSession& session);
// fit: null where the pairs are too few.
Json fit_json(std::uint64_t revision, const FittedPairs* fit, glm::ivec2 painting_px);
Json terrain_json(std::uint64_t revision, const FittedTerrain* terrain);

// The pair of that place already, if there is one.
std::optional<std::size_t> pair_of_place(const std::vector<ControlPair>& pairs, glm::dvec2 position,
                                         double within_m);
// A place of the map, and where it lies in the painting.
struct PlaceAnswer {
  KnownPlace place;
  std::optional<std::size_t> known = {};  // its number
  std::optional<std::size_t> pair = {};   // that it has already
  std::optional<ProposedPixel> painted = {};
  bool seen = true;
  double off_px = 0.0;  // of a proposal
};
Json place_json(const PlaceAnswer& answer);

}  // namespace belvedere::tools
