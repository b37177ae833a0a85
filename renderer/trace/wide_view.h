#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"

namespace belvedere {

// What a stage reads beyond its own pixels: the same picture in pixels that are `factor` times as
// wide and high, one ray each. Wide effects (ribs, lanes of forests, mist between ranges, forest
// around) are smooth over half a unit of the sheet, so a print need not read every pixel of its
// surroundings; where a unit is less than four pixels the factor is 1 and these are the pixels
// themselves. Holds depth, position, mapped class and fall line; for rock, normal and footprint (of
// its own pixels) instead of the position.
struct WideView {
  const GuidanceBuffers& seen;
  int factor = 1;
  glm::ivec2 origin_px{0};  // of `seen`, in its own pixels
  // Of the same pixels, what smooth_fall_lines (renderer/rock/spurs.h) makes of the fall lines;
  // null: whoever needs it makes it.
  const Grid<glm::vec2>* smooth_fall = nullptr;

  // Column or row of `seen` that contains a column or row of the sheet (0…65535); otherwise the
  // nearest.
  int column(int sheet_x) const { return position(sheet_x, origin_px.x, seen.width()); }
  int row(int sheet_y) const { return position(sheet_y, origin_px.y, seen.height()); }
  // Whether it contains a position, that is, within the sheet where it reaches far enough.
  bool holds(int sheet_x, int sheet_y) const {
    const int x = sheet_x - origin_px.x * factor;
    const int y = sheet_y - origin_px.y * factor;
    return sheet_x >= 0 && sheet_y >= 0 && x >= 0 && y >= 0 && x < seen.width() * factor &&
           y < seen.height() * factor;
  }
  std::size_t index(int sheet_x, int sheet_y) const {
    return seen.depth_m.index(column(sheet_x), row(sheet_y));
  }

 private:
  int position(int sheet, int origin, int count) const {
    return std::clamp(std::max(sheet, 0) / factor - origin, 0, count - 1);
  }
};

// Every `times`-th pixel of a wide view in each direction, at the same positions whatever its
// window; pixels at its edge stand for cells that it contains in part. Without positions.
GuidanceBuffers thin_out(const WideView& wide, int times);
glm::ivec2 thinned_origin(const WideView& wide, int times);

// Sheet pixels per wide pixel, so that two remain per unit of the sheet.
int wide_factor(double pixels_per_unit);
// The wide pixels that contain a rectangle of the sheet, and those whose centres are on either side
// of its border.
PixelRect wide_rect(PixelRect sheet_rect, int factor);

}  // namespace belvedere
