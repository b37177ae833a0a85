#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"

namespace belvedere {

// What a stage looks at beyond its own pixels: the same picture in pixels that are `factor` times as wide and high, one ray each. What
// reaches far (ribs, lanes of forests, mist between ranges, wood around) is smooth over half a unit of the sheet, so a print need not look
// at every pixel of its surroundings; where a unit is less than four pixels the factor is 1 and these are the pixels themselves.
// Holds depth, place, class as mapped and fall line; for rock normal and footprint (of its own pixels) instead of the place.
struct WideView {
  const GuidanceBuffers& seen;
  int factor = 1;
  glm::ivec2 origin_px{0};  // of `seen`, in its own pixels

  // Column or row of `seen` that holds a column or row of the sheet (0…65535); the nearest there is.
  int column(int sheet_x) const { return place(sheet_x, origin_px.x, seen.width()); }
  int row(int sheet_y) const { return place(sheet_y, origin_px.y, seen.height()); }
  // Whether a place lies in it: within the sheet, where it reaches far enough.
  bool holds(int sheet_x, int sheet_y) const {
    const int x = sheet_x - origin_px.x * factor;
    const int y = sheet_y - origin_px.y * factor;
    return sheet_x >= 0 && sheet_y >= 0 && x >= 0 && y >= 0 && x < seen.width() * factor && y < seen.height() * factor;
  }
  std::size_t index(int sheet_x, int sheet_y) const { return seen.depth_m.index(column(sheet_x), row(sheet_y)); }

 private:
  int place(int sheet, int origin, int count) const { return std::clamp(std::max(sheet, 0) / factor - origin, 0, count - 1); }
};

// Every `times`-th pixel each way of a wide view, those of the same places whatever window it holds; pixels at its rim stand for cells that
// it holds in part. Without places.
GuidanceBuffers thin_out(const WideView& wide, int times);
glm::ivec2 thinned_origin(const WideView& wide, int times);

// Pixels of the sheet to a pixel of the wide view: as many as leave two to a unit of the sheet.
int wide_factor(double pixels_per_unit);
// The wide pixels that hold a rectangle of the sheet, and those between whose middles its border lies.
PixelRect wide_rect(PixelRect sheet_rect, int factor);

}  // namespace belvedere
