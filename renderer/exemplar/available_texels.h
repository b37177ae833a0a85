#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/guidance_buffers.h"

namespace belvedere {

// The texels that a painting offers: of each class by light, distance, direction and altitude, and
// along the borders of classes. Sky is not counted.
struct AvailableTexels {
  static constexpr int tones = 5;      // 0…1 in equal steps
  static constexpr int distances = 4;  // with bounds distance_bounds_m
  static constexpr int directions =
      8;  // of the fall line in the image: 0 right, 2 down, 4 left, 6 up
  static constexpr int altitudes = 3;  // low, middle, high: with bounds altitude_bounds_m
  static constexpr std::array<float, distances - 1> distance_bounds_m = {16000.F, 28000.F, 48000.F};
  static constexpr std::array<float, altitudes - 1> altitude_bounds_m = {900.F, 1500.F};

  template <class T>
  using ByClass = std::array<T, land_cover_class_count>;
  std::int64_t pixels = 0;  // of the painting, sky and margins included
  ByClass<std::int64_t> texels{};
  ByClass<std::array<std::array<std::int64_t, distances>, tones>>
      by_light{};  // [class][tone][distance]
  ByClass<std::array<std::int64_t, directions>> by_direction{};
  ByClass<std::array<std::int64_t, altitudes>> by_altitude{};
  ByClass<std::int64_t> in_cast_shadow{};
  ByClass<ByClass<std::int64_t>> border{};  // texels of one class next to the other on one
                                            // surface, of both sides; symmetric
  std::int64_t at_silhouette = 0;           // texels of the nearer side of a depth edge

  std::int64_t ground() const;
};

// Counts the texels of `guidance`, each with its class in `classes`: mapped or painted. Accumulates
// over parts.
void add_available(AvailableTexels& available, const GuidanceBuffers& guidance,
                   const Grid<LandCoverClass>& classes);

// Texels that an exemplar needs, for a painting of 4096 × 4096; scaled for smaller ones by area,
// for borders by length.
struct MinTexels {
  double texels = 60000;
  double light = 20000;      // each tone and distance of a class that is needed
  double direction = 20000;  // each direction of a class that is needed
  double shadow = 20000;
  double altitude = 60000;  // of forest: low, middle and high
  double border = 5000;
  double largest_share = 0.30;  // max share of the ground for one class
};

// The texels that occur in panoramas, measured on the program's own scenes (docs/exemplars.md).
// Classes, or lights of a class, that never occur need not be in an example sheet.
struct NeededTexels {
  template <class T>
  using ByClass = AvailableTexels::ByClass<T>;
  ByClass<bool> texels{};  // any at all
  ByClass<std::array<std::array<bool, AvailableTexels::distances>, AvailableTexels::tones>> light{};
  ByClass<std::array<bool, AvailableTexels::directions>> direction{};
  ByClass<bool> shadow{};
  ByClass<ByClass<bool>> border{};
};
// The built-in needs (data/sheet/needed_texels.toml), or others in that format.
const NeededTexels& built_in_needed_texels();
NeededTexels parse_needed_texels(std::string_view text, const std::string& name);

// One shortage of a painting.
struct TexelShortage {
  std::string what;       // "rock, tone 0.8-1, nearer than 16 km"
  double found = 0.0;     // texels
  double needed = 0.0;    // texels for this painting's size
  bool too_much = false;  // a class above its max share
};
std::vector<TexelShortage> find_gaps(const AvailableTexels& available, const NeededTexels& demand,
                                     const MinTexels& floors);

// As JSON, for coverage.json, and as plain text tables.
std::string available_json(const AvailableTexels& available,
                           const std::vector<TexelShortage>& gaps);
// judge: whether shortages are listed.
std::string available_text(const AvailableTexels& available, const std::vector<TexelShortage>& gaps,
                           bool judge);

// Names of the bins of AvailableTexels.
std::string distance_name(std::size_t bin);
std::string direction_name(std::size_t bin);
std::string altitude_name(std::size_t bin);

}  // namespace belvedere
