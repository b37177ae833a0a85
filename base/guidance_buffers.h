#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "base/error.h"
#include "base/grid.h"
#include "base/land_cover_class.h"
#include "base/math.h"

namespace belvedere {

// How the picture sees the ground.
struct ViewChannels {
  Grid<float> depth_m;   // distance from the eye along the ray; +inf is sky
  Grid<float> coverage;  // part of the pixel that is terrain, 0…1
  Grid<float> front;  // part of the pixel's samples on the winning surface, 0…1; < 1 at depth edges
  Grid<float> silhouette;   // depth discontinuity, 0…1; on the nearer side
  Grid<float> footprint_m;  // ground metres per pixel
  Grid<glm::vec2>
      fall_line;  // unit direction of steepest descent in the image (x right, y down); 0 where flat
  Grid<float> rim_m;  // distance on the ground to the edge of the known terrain
};

// The ground itself, at the position that each pixel sees.
struct GroundChannels {
  glm::dvec3 origin_m{0.0};    // origin of position_m, scene CRS
  Grid<glm::vec3> position_m;  // before deformation, scene CRS (x east, y north, z altitude),
                               // relative to the origin
  Grid<glm::vec3> normal;  // unit; generalized, exaggerated surface, not bent: the light must not
                           // follow the bend
  Grid<glm::vec3>
      normal_detail;  // unit; ungeneralized, exaggerated surface (used for ribs of rock)
  Grid<glm::vec3> normal_smooth;  // unit; generalized surface after a Gaussian of 120 m
  Grid<float> altitude_m;         // above the vertical datum, of the undeformed, ungeneralized DEM
  Grid<LandCoverClass> land_cover;
  Grid<float> slope_deg;        // of the unexaggerated DEM after a Gaussian of 60 m
  Grid<float> aspect_deg;       // clockwise from north, downhill
  Grid<float> ridge;            // signed: ridge > 0, valley < 0
  Grid<float> relief_s_m;       // height above the Gaussian mean of about 180 m
  Grid<float> relief_m_m;       // … of about 750 m
  Grid<float> relief_l_m;       // … of about 1.8 km
  Grid<float> valley_height_m;  // height above the lowest ground within 900 m
  Grid<float> built;  // building density: 0 open land, .3 a village, 1 the centre of a large town
  Grid<glm::vec2> grain;  // direction of fields and streets on the ground: (cos 2a, sin 2a) times
                          // the confidence, 0…1; a from east
  Grid<float> flow;       // base-10 logarithm of the upstream area in m²
};

// Relief that the DEM does not resolve: of rock (renderer/rock), and of open ground seen from near
// (renderer/close), which has only planes and tone. 0 elsewhere.
struct RockChannels {
  Grid<float> rock_height;  // units of the sheet (0.5 mm)
  Grid<std::uint32_t>
      rock_facet;  // number of the plane of a pixel; planes of one large spur share the upper half
  Grid<float> rock_tone;  // light on that relief, before the picture's; on near ground the tone
                          // that its forms add
  Grid<glm::vec2> rock_cover;  // shares of turf and of snow on it, 0…1
};

// Light, and the picture before strokes.
struct LightChannels {
  Grid<float> shadow;    // 1 lit by the sun, 0 in cast shadow
  Grid<float> sky_view;  // part of the sky seen, 0…1
  Grid<float> tone;      // the scalar light that indexes palettes, 0…1
  Image base;            // strokeless base picture, scene-linear
};

// Paintings whose strokes are known. Strokes overlap the borders of classes, so the paint of a
// pixel does not always belong to the class at its position.
struct PaintChannels {
  Grid<LandCoverClass> painted_class;  // class with the thickest paint
  Grid<std::uint32_t> painted_from;    // row-major index of the pixel of that class at which its
                                       // thickest stroke starts
  Grid<std::uint32_t> stroke;          // number of the stroke on top, from 1; 0 is bare canvas
  Grid<std::uint32_t> ground_from;     // as painted_from, in the layer without trees and houses
};

// Per-pixel description of a picture, both of a synthesis target and of an exemplar. It is in base
// because texture/ and renderer/ both use it. All grids have the picture's size, or are empty if a
// channel is absent. All values of a pixel come from the same sample, the one that won the pixel,
// so nothing mixes across a silhouette. Names in files, units and sky values: guidance_channels.h.
struct GuidanceBuffers : ViewChannels, GroundChannels, RockChannels, LightChannels, PaintChannels {
  int width() const { return depth_m.width(); }
  int height() const { return depth_m.height(); }
  bool is_sky(std::size_t i) const {
    return !(depth_m[i] < std::numeric_limits<float>::infinity());
  }
};

// How near ground is seen, 0…1, by the metres of it in a unit of the sheet (0.5 mm): at 1 its forms
// are larger than the elevation data resolve, and are invented.
inline float close_share(float metres_per_unit) {
  constexpr float near_m = 14.0F;
  constexpr float far_m = 25.0F;
  return 1.0F - smoothstep(near_m, far_m, metres_per_unit);
}

// The two of several shapes that cover most of a pixel: their numbers from 1, 0 where there is
// none, and their shares of it in 255ths.
struct MattePixel {
  std::array<std::uint16_t, 2> id{};
  std::array<std::uint8_t, 2> share{};
  bool operator==(const MattePixel&) const = default;
};

// The table of all guidance channels. Reading and writing files, the sheet of example panels,
// docs/guidance.md and the tests use it, so a new channel is a row here, its member in
// GuidanceBuffers and the stage that fills it.

// The grid in the buffers; std::visit gives it with its value type.
using GuidanceMember =
    std::variant<Grid<float> GuidanceBuffers::*, Grid<glm::vec2> GuidanceBuffers::*,
                 Grid<glm::vec3> GuidanceBuffers::*, Grid<LandCoverClass> GuidanceBuffers::*,
                 Grid<std::uint32_t> GuidanceBuffers::*>;

enum class ChannelKind {
  number,       // a number, or independent components
  direction,    // unit vector, or zero; normalized again after reading, since half is not exact
  class_id,     // a LandCoverClass
  stroke_id,    // counts from 1
  pixel_index,  // row-major index of a pixel of the same picture; changes when the picture is
                // cropped
};

// Type of the values in a file: half if 11 bits are enough, uint32 for ids, which are never
// filtered.
enum class ChannelStorage { half, float32, uint32 };

// Which stage fills a channel, and so which pictures may lack it. Scanned paintings have the
// channels that were drawn or derived for them, of whatever kind.
enum class ChannelMaker {
  trace,    // trace_guidance: every picture of a terrain has it
  relief,   // renderer/rock: every picture with light
  light,    // tone and base picture: every picture with light
  strokes,  // only example paintings whose strokes the program made
};

struct GuidanceChannel {
  GuidanceMember member;
  std::array<std::string_view, 3> names =
      {};                      // in the file, one for each component; "" for unused ones
  std::string_view part = {};  // part of the file; channels used together share one
  ChannelStorage type = ChannelStorage::half;
  ChannelKind kind = ChannelKind::number;
  ChannelMaker maker = ChannelMaker::trace;
  std::string_view unit = {};  // "" if it has none
  std::string_view meaning = {};
  glm::vec3 sky{0.F};  // components of sky pixels; ids as numbers
  std::optional<glm::vec3> paper =
      {};  // components of bare paper between the panels of a sheet, if different from sky

  std::size_t components() const;
};

// In the order of the file; the channels of a part are adjacent.
std::span<const GuidanceChannel> guidance_channels();
const GuidanceChannel& channel_of(GuidanceMember member);

// Whether the buffers have that channel, in their size.
bool has_channel(const GuidanceBuffers& guidance, GuidanceMember member);
// Checks the channels that a stage needs, once when it starts. Throws Error(kind) if a channel is
// absent or differs in size from the depths, with the stage, the channel and what fills it.
void require_channels(const GuidanceBuffers& guidance, std::initializer_list<GuidanceMember> needed,
                      const std::string& where, ErrorKind kind = ErrorKind::bug);

// A value from its components.
template <class T>
T value_of(glm::vec3 components) {
  if constexpr (std::is_same_v<T, glm::vec3>) {
    return components;
  } else if constexpr (std::is_same_v<T, glm::vec2>) {
    return {components.x, components.y};
  } else {
    return static_cast<T>(components.x);
  }
}

// Makes the grid of a channel with one value everywhere.
void fill_channel(GuidanceBuffers& guidance, const GuidanceChannel& channel, int width, int height,
                  glm::vec3 components);

}  // namespace belvedere
