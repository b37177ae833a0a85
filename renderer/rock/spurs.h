#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "renderer/paint/rock_kinds.h"
#include "renderer/rock/spur_peaks.h"
#include "renderer/trace/camera.h"

namespace belvedere {

// Relief of rock that a DEM does not contain. A wall consists of spurs of three sizes; a spur is a
// roof with flat flanks, a sharp crest, and a sharp gully where two meet. Smaller spurs run down
// the flanks of larger ones and stay within their borders. Spurs grow from jittered cells of the
// sheet and are tied by depth to the surface they start on. Positions are in units of the sheet
// (0.5 mm), x right, y down; heights and slopes in shares of a spur's own spacing.
inline constexpr float units_per_mm = 2.0F;
inline constexpr int spur_sizes = 3;
inline constexpr int spur_bands = 4;

// Size of spurs by the metres of ground in a mm of the sheet: near walls have large ones, far
// ranges small ones.
struct SpurBand {
  float up_to_m;  // max ground in a mm of the sheet
  float factor;   // factor on all sizes
};
inline constexpr std::array<SpurBand, spur_bands> spur_band_table = {
    {{41.0F, 1.25F}, {51.5F, 0.95F}, {64.7F, 0.72F}, {1e9F, 0.55F}}};
int spur_band(float metres_per_mm);
// Mean distance of neighbouring spurs, units.
float spur_spacing(const RockKind& kind, int size, int band);

// Funnels: broad hollows of a wall, where gullies converge. Noise of deviation 1 on the sheet; low
// in the centre of a funnel.
inline constexpr glm::dvec2 funnel_sigma_units{26.0, 60.0};
float funnel_at(std::uint64_t seed, glm::vec2 position);

// The ground under spurs: a wide view with normals and footprints, and its smoothed fall lines.
struct SpurGround {
  const WideView& wide;
  const Grid<glm::vec2>& fall;  // unit, of the wide pixels; at most max_lean from straight down
  double pixels_per_unit;
  std::uint64_t seed;
};
// Fall lines of a wide view, blurred over 4.8 units of their surface and limited to 60° from
// straight down the sheet: steeper inclinations look like a landslip. Of wide pixels in `wanted`;
// others point down.
Grid<glm::vec2> smooth_fall_lines(const WideView& wide, double pixels_per_unit, PixelRect wanted);
int smooth_fall_reach(double pixels_per_unit, int factor);  // wide pixels

enum class SpurPart : std::uint8_t { head, back, foot };

// The highest spur at a position.
struct SpurHit {
  const Spur* spur = nullptr;  // null: no spur here
  float height = -1e9F;
  float over_next = 0.0F;  // height above the second highest: 0 in a gully
  std::uint32_t next_id = 0;
  float across = 0.0F;     // from the crest, in spacings; > 0 to the side of turned(down, -90°)
  float along = 0.0F;      // from the head, in spacings of its slender form
  float steepness = 1.0F;  // of the flank
  glm::vec2 slope{0.0F};   // gradient of the height on the sheet, constant on each plane
  std::uint8_t side = 0;
  SpurPart part = SpurPart::back;
  std::uint32_t flank_id() const { return spur == nullptr ? 0U : spur->id * 3U + side + 1U; }
};
// `slender`: factor on lengths along spurs; `parent`: of the position.
SpurHit highest_spur(const SpurCells& cells, float slender, glm::vec2 position, float depth_m,
                     std::uint32_t parent);

// All three sizes at a position, and the nearest ramp.
struct SpurHits {
  std::array<SpurHit, spur_sizes> sizes;
  float below_ramp = 1e9F;     // units below its edge; < 0 above it
  float ramp_strength = 0.0F;  // 0…1, falling to 0 at its ends
  const SpurHit& operator[](std::size_t size) const { return sizes[size]; }
  SpurHit& operator[](std::size_t size) { return sizes[size]; }
};

// A ramp or chimney that crosses a wall diagonally: no spur continues beyond it.
struct Ramp {
  bool cut = false;
  glm::vec2 position{0.0F};
  glm::vec2 along{1.0F, 0.0F};  // unit, to the right
  float half_length = 1.0F;     // units
  float depth_m = 0.0F, tolerance_m = 0.0F;
  std::uint32_t id = 0;
};
struct RampCells {
  glm::ivec2 first{0};
  glm::ivec2 count{0};
  std::vector<Ramp> ramps;
};

struct SpurField {
  const RockKind* kind = nullptr;
  RampCells ramps;
  std::array<std::array<SpurCells, spur_sizes>, spur_bands> bands;
};

// Spurs of the requested bands that are visible in a rectangle of the sheet (px). Local up to
// spur_margin_units around it.
SpurField grow_spurs(const SpurGround& ground, const RockKind& kind, PixelRect sheet_rect,
                     const std::array<bool, spur_bands>& bands);
double spur_margin_units(const RockKind& kind);

// All three sizes at a position on the surface at depth_m.
SpurHits find_spurs(const SpurField& field, int band, glm::vec2 position, float depth_m);
// Height of the largest size alone, in its spacings; -1e9 without a spur.
float large_height(const SpurField& field, int band, glm::vec2 position, float depth_m);

}  // namespace belvedere
