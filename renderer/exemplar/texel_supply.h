#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/guidance_buffers.h"

namespace belvedere {

// What a painting has to copy from: texels of each class by the light, distance, direction and altitude they show, and along the borders
// of classes. Sky counts nowhere.
struct TexelSupply {
  static constexpr int tones = 5;       // 0…1 in equal steps
  static constexpr int distances = 4;   // parted at distance_bounds_m
  static constexpr int directions = 8;  // of the fall line in the image: 0 right, 2 down, 4 left, 6 up
  static constexpr int altitudes = 3;   // low, middle, high: parted at altitude_bounds_m
  static constexpr std::array<float, distances - 1> distance_bounds_m = {16000.F, 28000.F, 48000.F};
  static constexpr std::array<float, altitudes - 1> altitude_bounds_m = {900.F, 1500.F};

  template <class T>
  using ByClass = std::array<T, land_cover_class_count>;
  std::int64_t pixels = 0;  // of the painting, sky and margins included
  ByClass<std::int64_t> texels{};
  ByClass<std::array<std::array<std::int64_t, distances>, tones>> by_light{};  // [class][tone][distance]
  ByClass<std::array<std::int64_t, directions>> by_direction{};
  ByClass<std::array<std::int64_t, altitudes>> by_altitude{};
  ByClass<std::int64_t> in_cast_shadow{};
  ByClass<ByClass<std::int64_t>> border{};  // texels of the one class beside the other on one surface, of both sides; symmetric
  std::int64_t at_silhouette = 0;           // texels of the nearer side of a depth edge

  std::int64_t ground() const;
};

// Counts what `guidance` shows, each texel with the class in `classes`: what stands there or what is painted there. Adds up over parts.
void add_supply(TexelSupply& supply, const GuidanceBuffers& guidance, const Grid<LandCoverClass>& classes);

// How many texels an exemplar needs, for a painting of 4096 × 4096; smaller ones need their share of it, by area, of borders by length.
struct SupplyFloors {
  double texels = 60000;
  double light = 20000;      // each tone and distance of a class that occurs
  double direction = 20000;  // each direction of a class that occurs
  double shadow = 20000;
  double altitude = 60000;  // of forest, low, middle and high
  double border = 5000;
  double largest_share = 0.30;  // of the ground, one class
};

// What occurs in panoramas: measured on the program's own scenes (docs/exemplars.md). What never occurs need not be in an example sheet, be
// it a class or a light of one.
struct SupplyDemand {
  template <class T>
  using ByClass = TexelSupply::ByClass<T>;
  ByClass<bool> texels{};  // any at all
  ByClass<std::array<std::array<bool, TexelSupply::distances>, TexelSupply::tones>> light{};
  ByClass<std::array<bool, TexelSupply::directions>> direction{};
  ByClass<bool> shadow{};
  ByClass<ByClass<bool>> border{};
};
// The built-in demand (data/sheet/demand.toml), or one of that form.
const SupplyDemand& built_in_demand();
SupplyDemand parse_demand(std::string_view text, const std::string& name);

// One thing a painting lacks.
struct SupplyGap {
  std::string what;       // "rock, tone 0.8-1, nearer than 16 km"
  double found = 0.0;     // texels
  double needed = 0.0;    // texels for this painting's size
  bool too_much = false;  // a class over its largest share
};
std::vector<SupplyGap> find_gaps(const TexelSupply& supply, const SupplyDemand& demand, const SupplyFloors& floors);

// For machines, in the file that users know as coverage.json, and for people: tables in plain text.
std::string supply_json(const TexelSupply& supply, const std::vector<SupplyGap>& gaps);
// judge: whether the gaps are said.
std::string supply_text(const TexelSupply& supply, const std::vector<SupplyGap>& gaps, bool judge);

}  // namespace belvedere
