#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "base/progress.h"
#include "renderer/scene/scene_file.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/light_field.h"
#include "renderer/trace/terrain_model.h"
#include "renderer/trace/tracer.h"
#include "renderer/world/view.h"
#include "terrain/io/dem.h"

namespace belvedere {

// The light of a scene's regions and clouds, on its terrain and under its sun; null where it has
// neither. Throws Error(usage) where the picture's sun is not above the horizon, and for errors in
// positions and files of areas; Error(input) for a required file that is missing. Notes optional
// files that are missing: their regions are left out.
std::shared_ptr<const LightField> make_light_field(const LoadedScene& loaded, const Dem& dem,
                                                   const View& view,
                                                   Progress& progress = silent_progress());

// Light on the ranges of a picture, before it is rendered, and where turning it would help.

// A point of a slope that a pixel shows. Level ground has no lit and no dark side, and is left out.
struct SeenSlope {
  glm::dvec2 position{0.0};  // on the map
  double altitude_m = 0.0;
  double distance_m = 0.0;  // from the viewer
  glm::dvec3 normal{0.0};   // of the slope as drawn, smoothed over about 200 m
  glm::dvec3 start{0.0};    // of rays towards the sun, in the deformed world
};
// Samples the slopes in view at every `step`-th pixel and row. Uses dem and generalized_m of
// `terrain`.
std::vector<SeenSlope> see_slopes(const TerrainModel& terrain, double exaggeration,
                                  const Tracer& tracer, const Camera& camera, int step);

// The ground around one summit: slopes that are nearer to it than to any other of the summits, as
// far as a picture distinguishes them.
struct SeenRange {
  glm::dvec2 summit{0.0};
  double altitude_m = 0.0;
  double distance_m = 0.0;
  glm::dvec2 centre{0.0};  // of its visible slopes
  double radius_m = 0.0;   // radius around the centre that holds three quarters of them
  double share = 0.0;      // of all visible slopes, 0…1
  double lit = 0.0;        // shares of its own slopes: lit
  double cast = 0.0;       // in cast shadow
  double away = 0.0;       // facing away from the sun
  std::vector<std::size_t> slopes = {};

  // Most of it is in shade, so that its forms are lost.
  bool in_shade() const { return lit < 0.40; }
};
// Finds ranges by their summits: the highest points first, each at some distance from the previous
// ones; ranges of less than .02 of the slopes are left out. By falling share. Without light.
std::vector<SeenRange> find_ranges(std::span<const SeenSlope> slopes);
// Adds the shares of light to ranges. `sun`: direction in the picture; `field`: null for uniform
// light.
void light_ranges(std::vector<SeenRange>& ranges, std::span<const SeenSlope> slopes,
                  const Tracer& tracer, glm::dvec3 sun, const LightField* field);

// A region that would light a range, with the lit share of its slopes without and with it.
struct ProposedLight {
  SceneLightRegion region;
  double lit_before = 0.0;
  double lit_after = 0.0;
};
// Proposes regions for ranges in shade, the largest first, six at most: of turns of the sun to both
// sides the one that lights the ranges of the picture best, if that is a clear improvement. In the
// order in which they combine with the scene's own regions.
std::vector<ProposedLight> propose_light(const LoadedScene& loaded, const Dem& dem,
                                         const View& view, std::span<const SeenSlope> slopes,
                                         const Tracer& tracer);
// The regions as TOML, by longitude and latitude where the terrain has a CRS; a comment above each.
std::string proposed_light_text(std::span<const ProposedLight> proposals);

}  // namespace belvedere
