#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/math.h"
#include "renderer/close/close_borders.h"
#include "renderer/close/debris_cones.h"
#include "renderer/close/roofs.h"
#include "renderer/paint/light.h"
#include "renderer/rock/rock_view.h"

namespace belvedere {

// Cover of near ground, by the kind of its forms.
enum class CloseCover : std::uint8_t { other, snow, scree, grass };
inline constexpr std::size_t close_covers = 4;
CloseCover close_cover(LandCoverClass id, bool winter);

// Sizes of forms. Those of snow come in two directions: ribs down the fall line, swells along the
// wind; slabs are broad and low and hold the basins together.
enum CloseSize : std::size_t {
  ribs,
  small_ribs,
  flutes,
  slabs,
  swells,
  small_swells,
  scree_roofs,
  grass_roofs,
  grass_slopes,
  close_sizes
};

// The forms of a window's near ground, and what their light reads.
struct CloseScene {
  const GuidanceBuffers& guidance;
  const RockParameters& parameters;
  const SpurGround& ground;
  glm::ivec2 origin_px;
  PixelRect made;  // pixels of the window that may be looked at
  Warp warp;
  const DebrisCones& cones;
  const IceAround& ice;
  std::array<SpurCells, close_sizes> roofs = {};
  std::array<Grid<float>, 3> mean_normal = {};  // of wide pixels: the large form that light rakes
  std::array<Grid<float>, 3> dome_normal = {};  // of what that rises from
  Grid<float> calm = {}, small_calm = {}, steepness = {}, terraces = {}, quiet = {};
  Grid<float> runnels = {};  // all of deviation 1
  Grid<float> streams =
      {};  // of wide pixels: light and dark bands along the flow of ice, about -1…1
};
// Forms of the covers that are `present`. Reaches close_forms_reach_units for roofs, and
// mean_normal_reach and streams_reach wide pixels.
CloseScene make_close_scene(const GuidanceBuffers& guidance, const RockParameters& parameters,
                            const SpurGround& ground, const DebrisCones& cones,
                            const IceAround& ice, glm::ivec2 origin_px, PixelRect made,
                            const std::array<bool, close_covers>& present);
float close_forms_reach_units();
int mean_normal_reach(double pixels_per_unit, int factor);
int streams_reach(double pixels_per_unit, int factor);

// Appearance of the forms at a position in a pixel of that cover.
struct FormLook {
  float tone = 0.0F;        // added to the ground's own, about -.5…+.5
  std::uint32_t plane = 0;  // of the form that strokes follow; 0: none
  std::uint32_t edges = 0;  // differs where any plane does
};
FormLook look_at_form(const CloseScene& scene, int x, int y, CloseCover cover, glm::dvec2 within);

// Directions on the ground that belong to the fall line on the sheet and to its right.
struct SlopeFrame {
  glm::vec3 normal;
  glm::vec3 down{0.0F};
  glm::vec3 across{0.0F};

  explicit SlopeFrame(glm::vec3 n);
  // The normal under a form of this gradient on the sheet.
  glm::vec3 tilted(glm::vec2 gradient, glm::vec2 fall) const;
};

// The light that forms on a large form get.
struct RakingLight {
  glm::vec3 sun;
  float strength = 1.0F;

  float facing(glm::vec3 normal) const;  // 0…1
  // How much lighter a form of that normal is than the ground it lies on.
  float operator()(glm::vec3 form, glm::vec3 ground) const {
    return strength * (facing(form) - facing(ground));
  }
};

// Light at a pixel for forms on a large form of normal `mean`: a sun that stands too high above it
// (or, except on snow, too low behind it) is turned until it rakes.
RakingLight raking_light(const ToneParameters& parameters, const GuidanceBuffers& guidance,
                         std::size_t i, glm::vec3 mean, bool snow);
// The same with the sun where it is.
RakingLight sun_light(const ToneParameters& parameters, const GuidanceBuffers& guidance,
                      std::size_t i, float strength);

}  // namespace belvedere
