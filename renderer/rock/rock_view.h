#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/guidance_buffers.h"
#include "renderer/paint/light.h"
#include "renderer/paint/rock_kinds.h"
#include "renderer/rock/spurs.h"
#include "renderer/trace/wide_view.h"

namespace belvedere {

struct RockParameters {
  ToneParameters light;
  const RockKind* kind = nullptr;  // of rock_kinds()
  bool winter = false;
};

// A cell of the partition: where its point lies and what it sees there.
struct BandCell {
  glm::vec2 place{0.0F};
  float depth_m = -1.0F;  // none: sky, or off the sheet
  int band = 0;
};

// Which sizes spurs have at a pixel: those of the nearest cell point on about its own distance, so that no seam of sizes crosses a facet.
struct BandPartition {
  glm::ivec2 first{0};
  glm::ivec2 count{0};
  std::vector<BandCell> cells;

  int at(glm::vec2 place, float depth_m, float metres_per_mm) const;
};

// Places at which spurs are looked up, moved a little, so that edges of planes are broken rather than straight: two waverings, by noise
// with straight flanks, because smooth noise curls them.
struct Warp {
  std::array<std::uint64_t, 4> seeds{};
  explicit Warp(std::uint64_t seed);
  // `scale`: pixels in a unit; what is too fine to be seen is left out.
  glm::vec2 operator()(glm::vec2 place, float scale) const;
};

// The spurs of a window of the sheet, and what they stand on.
struct RockView {
  GuidanceBuffers thin;  // of the wide view, about a pixel a unit: all that is looked at here is smooth over a unit
  int factor = 1;        // of its pixels
  glm::ivec2 origin_px{0};
  Grid<glm::vec2> fall;
  BandPartition bands;
  SpurField field;
  Warp warp;
  float pixels_per_unit = 1.0F;

  WideView far() const { return {thin, factor, origin_px}; }
  // The spurs at a place, units of the sheet, in front of a pixel's depth.
  SpurHits at(glm::vec2 place, int band, float depth_m) const { return find_spurs(field, band, warp(place, pixels_per_unit), depth_m); }
};
// `made`: pixels of the window, and beside it, whose spurs are asked for. Looks at the wide view within rock_view_margin_px of them.
RockView view_rock(const GuidanceBuffers& guidance, const WideView& wide, const RockParameters& parameters, glm::ivec2 origin_px,
                   PixelRect made);
int rock_view_margin_px(const RockParameters& parameters);
// Pixels of the sheet to a pixel of the view that rock is looked at in: one is left to a unit.
int rock_factor(double pixels_per_unit);
// Pixels of another wide view to one of it.
int thinned_times(double pixels_per_unit, int factor);

}  // namespace belvedere
