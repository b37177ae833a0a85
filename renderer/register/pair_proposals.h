#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/register/registered_ground.h"
#include "terrain/io/dem.h"
#include "terrain/register/registration.h"

namespace belvedere {

// Altitude of a place, between cells; nothing outside the DEM and in voids that were filled.
std::optional<double> measured_altitude_m(const Dem& dem, glm::dvec2 position);

// A place that a person may recognize in a painting: a summit of the DEM, or a place of a file.
struct KnownPlace {
  std::string name = {};  // empty: not known
  glm::dvec2 position{0.0};
  double altitude_m = 0.0;
  double prominence_m = 0.0;  // 0: not a summit of the DEM
};

// A place of a file.
struct NamedPlace {
  std::string name;
  glm::dvec2 position{0.0};  // CRS of the DEM
  bool summit = false;       // it lies on a summit near by, whatever the file says
};

struct KnownPlacesParameters {
  double min_prominence_m = 30.0;  // of summits, > 0
  std::size_t max_summits = 4000;  // the most prominent ones
  double near_by_m = 300.0;        // a name of a summit belongs to the nearest one within it
};

// The summits of a DEM, most prominent first, with the names of those that are named, and behind
// them the other places of the file that lie within the DEM.
std::vector<KnownPlace> known_places(const Dem& dem, std::span<const NamedPlace> named,
                                     const KnownPlacesParameters& parameters = {});

// The place nearest to a position, at most radius_m away; of equally near ones the first.
std::optional<std::size_t> nearest_place(std::span<const KnownPlace> places, glm::dvec2 position,
                                         double radius_m);

// Where a registration shows a place.
struct ProposedPixel {
  glm::dvec2 pixel{0.0};  // of the painting; may lie outside of it
  double sigma_px = 0.0;  // how far it may be off in one direction, standard deviation
};
ProposedPixel propose_pixel(const Registration& registration, const DisplacementField& field,
                            const KnownPlace& place);

// Whether no ground hides a place.
bool is_seen(const RegisteredView& view, const KnownPlace& place);

// A place that a pixel of the painting may show.
struct ProposedPlace {
  std::size_t place = 0;  // index
  double off_px = 0.0;    // from the pixel to where the registration shows it
};

// The places that a pixel may show, the likeliest first: those within 3 deviations, but at least 12
// and at most 60 px of a painting 1200 px wide; scale: px of the painting per such px. The
// likelihood of one at the distance d is prominence / sigma² exp(-d² / (2 sigma²)), since people
// recognize what stands out; a named place counts like a summit of 300 m at least. `seen` of each
// place: others are left out.
std::vector<ProposedPlace> propose_places(std::span<const KnownPlace> places,
                                          std::span<const ProposedPixel> pixels,
                                          const std::vector<bool>& seen, glm::dvec2 pixel,
                                          double scale);

// A line along which the ground ends before the sky (a part of the skyline) or before ground
// farther away (a ridge), from left to right.
struct SeenLine {
  bool skyline = false;
  std::vector<glm::vec2>
      points;  // px of the ground's grid, (0, 0) its outer corner at the top left
};

struct SeenLinesParameters {
  float min_jump = 1.06F;  // of distance across a ridge, as a ratio, > 1
  int max_step_px = 5;     // a line rises or falls by at most this from column to column
  int min_length_px = 8;   // columns; shorter ones are left out
};

// Skyline and ridges of the ground, linked from column to column: each end of a line goes on at the
// nearest jump of its kind.
std::vector<SeenLine> seen_lines(const RegisteredGround& ground,
                                 const SeenLinesParameters& parameters = {});

}  // namespace belvedere
