#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "renderer/scene/scene_file.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/light_field.h"
#include "renderer/trace/terrain_model.h"
#include "renderer/trace/tracer.h"
#include "renderer/world/view.h"

namespace belvedere {

// How the light falls on the ranges that a picture shows, before it is made, and where turning it would help.

// A place of a slope that a pixel shows. Level ground has no lit and no dark side, and is left out.
struct SeenSlope {
  glm::dvec2 place{0.0};  // on the map
  double altitude_m = 0.0;
  double distance_m = 0.0;  // from the eye
  glm::dvec3 normal{0.0};   // of the slope as drawn, smoothed over some 200 m
  glm::dvec3 start{0.0};    // of rays towards the sun, in the deformed world
};
// Of every `step`-th pixel and row. Of `terrain` it reads dem and generalized_m.
std::vector<SeenSlope> see_slopes(const TerrainModel& terrain, double exaggeration, const Tracer& tracer, const Camera& camera, int step);

// What lies around one summit: slopes that are nearer to it than to any other of the summits, as far as a picture tells them apart.
struct SeenRange {
  glm::dvec2 summit{0.0};
  double altitude_m = 0.0;
  double distance_m = 0.0;
  glm::dvec2 middle{0.0};  // of its slopes that are seen
  double radius_m = 0.0;   // three quarters of them lie so near to the middle
  double share = 0.0;      // of all slopes seen, 0…1
  double lit = 0.0;        // shares of its own slopes: lit …
  double cast = 0.0;       // … in a shadow that something else casts …
  double away = 0.0;       // … or turned away from the sun
  std::vector<std::size_t> slopes = {};

  // Most of it stands in shade, so that its forms are lost.
  bool in_shade() const { return lit < 0.40; }
};
// The highest places first become summits, each at some distance from those before; ranges of less than .02 of the slopes are left out.
// By falling share. Light is not asked yet.
std::vector<SeenRange> find_ranges(std::span<const SeenSlope> slopes);
// Fills in how light falls on them. `sun`: of the picture; `field`: null for one light everywhere.
void light_ranges(std::vector<SeenRange>& ranges, std::span<const SeenSlope> slopes, const Tracer& tracer, glm::dvec3 sun,
                  const LightField* field);

// A region that would turn a range to the light, with the share of its slopes that is lit without and with it.
struct ProposedLight {
  SceneLightRegion region;
  double lit_before = 0.0;
  double lit_after = 0.0;
};
// For ranges in shade, the largest first, six at most: of turns of the sun to both sides the one that lights the ranges of the picture
// best, where that is clearly better than nothing. In the order in which they work together with the regions that the scene has.
std::vector<ProposedLight> propose_light(const LoadedScene& loaded, const Dem& dem, const View& view, std::span<const SeenSlope> slopes,
                                         const Tracer& tracer);
// The regions as a scene file says them, by longitude and latitude where the terrain has a CRS; a line of comment over each.
std::string proposed_light_text(std::span<const ProposedLight> proposals);

}  // namespace belvedere
