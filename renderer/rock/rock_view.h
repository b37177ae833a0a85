#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/parallel.h"
#include "renderer/paint/light.h"
#include "renderer/paint/rock_kinds.h"
#include "renderer/rock/spurs.h"
#include "renderer/trace/camera.h"

namespace belvedere {

struct RockParameters {
  ToneParameters light;
  const RockKind* kind = nullptr;  // of rock_kinds()
  bool winter = false;
};

// A cell of the partition: the position of its point and the depth there.
struct BandCell {
  glm::vec2 position{0.0F};
  float depth_m = -1.0F;  // < 0: sky, or off the sheet
  int band = 0;
};

// The sizes of spurs at a pixel: those of the nearest cell point at about its own distance, so that
// no change of sizes crosses a facet.
struct BandPartition {
  glm::ivec2 first{0};
  glm::ivec2 count{0};
  std::vector<BandCell> cells;

  int at(glm::vec2 position, float depth_m, float metres_per_mm) const;
};

// Small offsets of the positions at which spurs are looked up, so that edges of planes are broken
// rather than straight. Two sizes of noise with straight flanks, because smooth noise curls the
// edges.
struct Warp {
  std::array<std::uint64_t, 4> seeds{};
  explicit Warp(std::uint64_t seed);
  // `scale`: pixels in a unit; invisibly fine offsets are left out.
  glm::vec2 operator()(glm::vec2 position, float scale) const;
};

// A wide view in about one pixel per unit, and its smoothed fall lines: everything that rock reads
// from afar is smooth over a unit. What the wide view holds already is referred to.
class FarView {
 public:
  // Fall lines of the pixels of `read`, a rectangle of the sheet; of others only if they are there.
  FarView(const WideView& wide, double pixels_per_unit, PixelRect read);

  const WideView& wide() const { return wide_; }
  const Grid<glm::vec2>& fall() const { return *wide_.smooth_fall; }
  PixelRect whole() const { return {0, 0, wide_.seen.width(), wide_.seen.height()}; }

 private:
  FarView(std::shared_ptr<const GuidanceBuffers> thin, const WideView& wide, double pixels_per_unit,
          PixelRect read);

  std::shared_ptr<const GuidanceBuffers> thin_;
  std::shared_ptr<const Grid<glm::vec2>> smoothed_;
  WideView wide_;
};

// The spurs of a window of the sheet, and the ground under them.
struct RockView {
  FarView far;
  BandPartition bands;
  SpurField field;
  Warp warp;
  float pixels_per_unit = 1.0F;

  // The spurs at a position, units of the sheet, in front of a pixel's depth.
  SpurHits at(glm::vec2 position, int band, float depth_m) const {
    return find_spurs(field, band, warp(position, pixels_per_unit), depth_m);
  }
};
// `made`: pixels inside or outside the window whose spurs are needed. Reads the wide view within
// rock_view_margin_px of them.
RockView view_rock(const GuidanceBuffers& guidance, const WideView& wide,
                   const RockParameters& parameters, glm::ivec2 origin_px, PixelRect made);
int rock_view_margin_px(const RockParameters& parameters);
// Sheet pixels per pixel of the view in which rock is computed: one remains per unit.
int rock_factor(double pixels_per_unit);
// Pixels of another wide view per pixel of it.
int thinned_times(double pixels_per_unit, int factor);

// The smallest rectangle that contains all pixels of `in` that pass a test; empty where none does.
template <class Test>
PixelRect extent_of(PixelRect in, Test&& test) {
  if (in.empty()) return {in.x1, in.y1, in.x0, in.y0};
  struct Span {
    int first;
    int end;
  };
  std::vector<Span> spans(static_cast<std::size_t>(in.height()), Span{in.x1, in.x0});
  parallel_ranges(in.height(), 16, [&](int begin, int end) {
    for (int row = begin; row != end; ++row) {
      Span& span = spans[static_cast<std::size_t>(row)];
      const int y = in.y0 + row;
      int x = in.x0;
      while (x < in.x1 && !test(x, y)) ++x;
      if (x == in.x1) continue;
      span.first = x;
      x = in.x1 - 1;
      while (!test(x, y)) --x;
      span.end = x + 1;
    }
  });
  PixelRect extent{in.x1, in.y1, in.x0, in.y0};
  for (int row = 0; row < in.height(); ++row) {
    const Span& span = spans[static_cast<std::size_t>(row)];
    if (span.end <= span.first) continue;
    extent = {std::min(extent.x0, span.first), std::min(extent.y0, in.y0 + row),
              std::max(extent.x1, span.end), in.y0 + row + 1};
  }
  return extent;
}

// Whether a neighbour above, below or beside holds another value: one pixel of two planes.
template <class T>
bool is_edge(const Grid<T>& planes, int x, int y) {
  const T own = planes(x, y);
  return (x > 0 && planes(x - 1, y) != own) ||
         (x + 1 < planes.width() && planes(x + 1, y) != own) ||
         (y > 0 && planes(x, y - 1) != own) || (y + 1 < planes.height() && planes(x, y + 1) != own);
}

}  // namespace belvedere
