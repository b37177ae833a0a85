#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/land_cover_class.h"

namespace belvedere {

// Hues of small dabs, warm and cool.
enum class DabHue : std::uint8_t { none, earth, leaves, ice };

// Brushwork of a class. Lengths and widths in units of 0.5 mm of the sheet.
struct ClassStrokes {
  float wash_length;      // 0: no wash, all its strokes are of special kinds
  float wash_width;       // at the start of the stroke
  float wash_wander_rad;  // deviation of the direction
  float meadow_length;    // of strokes of grass; 0: no grass
  DabHue dabs;
};

// A row for each land-cover class, in the order of their table.
struct ClassStrokesRow {
  LandCoverClass id;
  ClassStrokes strokes;
};
inline constexpr auto class_strokes_table = [] {
  using enum LandCoverClass;
  return std::to_array<ClassStrokesRow>({
      {sky,
       {.wash_length = 0.0F,
        .wash_width = 0.0F,
        .wash_wander_rad = 0.00F,
        .meadow_length = 0.0F,
        .dabs = DabHue::none}},
      {water,
       {.wash_length = 0.0F,
        .wash_width = 0.0F,
        .wash_wander_rad = 0.00F,
        .meadow_length = 0.0F,
        .dabs = DabHue::none}},
      {valley_floor,
       {.wash_length = 10.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.15F,
        .meadow_length = 9.0F,
        .dabs = DabHue::earth}},
      {settlement,
       {.wash_length = 10.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.15F,
        .meadow_length = 0.0F,
        .dabs = DabHue::none}},
      {forest,
       {.wash_length = 8.0F,
        .wash_width = 4.0F,
        .wash_wander_rad = 0.20F,
        .meadow_length = 0.0F,
        .dabs = DabHue::leaves}},
      {alpine_grass,
       {.wash_length = 10.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.30F,
        .meadow_length = 7.6F,
        .dabs = DabHue::earth}},
      {scree,
       {.wash_length = 10.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.20F,
        .meadow_length = 0.0F,
        .dabs = DabHue::earth}},
      {rock,
       {.wash_length = 0.0F,
        .wash_width = 0.0F,
        .wash_wander_rad = 0.00F,
        .meadow_length = 0.0F,
        .dabs = DabHue::none}},
      {snow,
       {.wash_length = 20.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.08F,
        .meadow_length = 0.0F,
        .dabs = DabHue::ice}},
      {glacier,
       {.wash_length = 20.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.08F,
        .meadow_length = 0.0F,
        .dabs = DabHue::ice}},
      {pasture,
       {.wash_length = 10.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.30F,
        .meadow_length = 8.0F,
        .dabs = DabHue::earth}},
      {shrub,
       {.wash_length = 10.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.30F,
        .meadow_length = 8.0F,
        .dabs = DabHue::leaves}},
      {sand,
       {.wash_length = 14.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.10F,
        .meadow_length = 0.0F,
        .dabs = DabHue::earth}},
  });
}();
static_assert(class_strokes_table.size() == land_cover_table.size());
static_assert(std::equal(class_strokes_table.begin(), class_strokes_table.end(),
                         land_cover_table.begin(),
                         [](const ClassStrokesRow& row, const LandCoverClassInfo& info) {
                           return row.id == info.id;
                         }));

constexpr const ClassStrokes& strokes_of(LandCoverClass id) {
  return class_strokes_table[static_cast<std::size_t>(id)].strokes;
}

}  // namespace belvedere
