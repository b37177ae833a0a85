#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace belvedere {

// The classes that a panorama is painted in. A legend maps the codes of a land-cover raster to
// them; each has palettes and brushes. The numbers are written to guidance files and never change;
// new classes get new numbers.
enum class LandCoverClass : std::uint8_t {
  sky = 0,
  water = 1,
  valley_floor = 2,
  settlement = 3,
  forest = 4,
  alpine_grass = 5,
  scree = 6,
  rock = 7,
  snow = 8,
  glacier = 9,
  pasture = 10,
  shrub = 11,
  sand = 12,
};

// Properties that a class has or not.
enum class ClassTrait : std::uint32_t {
  none = 0,
  open_high = 1U << 0,  // forest thins out towards it; not so for ground that people keep clear
  own_relief =
      1U << 1,  // lit with the ungeneralized surface's detail, else with the generalized surface
  bleaches = 1U << 2,      // high grass: fresh in hollows, bleached on ridges
  drifts = 1U << 3,        // its hue changes slowly over the ground
  desaturates = 1U << 4,   // a green that desaturates with distance
  gravel_banks = 1U << 5,  // rivers deposit gravel on it
  level = 1U << 6,         // strokes are horizontal, not along the fall line
  tight = 1U << 7,         // strokes must not smear across the smallest ridge
  icy = 1U << 8,           // thick, smooth paint with little bristle texture
  turf = 1U << 9,          // grows over the rims of rock
  lone_trees = 1U << 10,   // scattered trees
  accents = 1U << 11,      // gets accents of light on edges and of dark in hollows
};
constexpr ClassTrait operator|(ClassTrait a, ClassTrait b) {
  return static_cast<ClassTrait>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}

// How light falls on a class.
struct ClassTone {
  float detail;    // share of the detailed normal, 0…1; the rest is the smooth one
  float edges;     // strength of light on ridges and of dark in hollows
  float ribs;      // strength of ribs and gullies on slopes
  float contrast;  // around the middle tone; 1 leaves tones unchanged
  float lift;      // added to the tone
};

// Shift of grass towards ripe yellow (+) or fresh green (-): by noise of 60, 210 and 660 m, and
// uniformly.
struct ClassRipeness {
  float n3, n8, n25, mean;
};

// How a class's colour deviates from its ramp.
struct ClassHue {
  ClassRipeness ripeness;
  float warmth;         // share of the foreground's warmth that applies to it, 0…1
  float relief_accent;  // how strongly ridges and hollows are marked, 0…1
};

struct LandCoverClassInfo {
  LandCoverClass id;
  std::string_view name;     // as written in scenes, legends and file headers
  std::string_view meaning;  // for the table of docs/legends.md
  std::uint32_t rgb;        // 0xrrggbb, for class maps only; the painting's colours are in palettes
  LandCoverClass stand_in;  // class to copy from if no exemplar has this one and the scene sets
                            // nothing; itself: none
  ClassTrait traits;
  ClassTone tone;
  ClassHue hue;
};

// The table of all classes: a new class is an enumerator above and a row here, in the order of ids.
// No member has a default, so an incomplete row does not compile.
inline constexpr auto land_cover_table = [] {
  using enum LandCoverClass;
  using enum ClassTrait;
  return std::to_array<LandCoverClassInfo>({
      {.id = sky,
       .name = "sky",
       .meaning = "no terrain",
       .rgb = 0xc8dcff,
       .stand_in = sky,
       .traits = none,
       .tone = {.detail = 0.00F, .edges = 0.00F, .ribs = 0.00F, .contrast = 1.00F, .lift = 0.00F},
       .hue = {.ripeness = {0.00F, 0.00F, 0.00F, 0.00F}, .warmth = 1.00F, .relief_accent = 0.35F}},
      {.id = water,
       .name = "water",
       .meaning = "lakes, rivers, the sea",
       .rgb = 0x285ac8,
       .stand_in = water,
       .traits = none,
       .tone = {.detail = 0.45F, .edges = 0.07F, .ribs = 0.00F, .contrast = 0.55F, .lift = 0.00F},
       .hue = {.ripeness = {0.00F, 0.00F, 0.00F, 0.00F}, .warmth = 1.00F, .relief_accent = 0.35F}},
      {.id = valley_floor,
       .name = "valley_floor",
       .meaning = "fields, meadows and parks of the valley bottom",
       .rgb = 0xe6dc6e,
       .stand_in = valley_floor,
       .traits = drifts | desaturates | gravel_banks | level | lone_trees | accents,
       .tone = {.detail = 0.45F, .edges = 0.07F, .ribs = 0.00F, .contrast = 0.55F, .lift = 0.10F},
       .hue = {.ripeness = {0.00F, 0.12F, 0.00F, 0.00F}, .warmth = 1.00F, .relief_accent = 0.35F}},
      {.id = settlement,
       .name = "settlement",
       .meaning = "towns, villages",
       .rgb = 0xc83c3c,
       .stand_in = settlement,
       .traits = level,
       .tone = {.detail = 0.45F, .edges = 0.07F, .ribs = 0.00F, .contrast = 0.55F, .lift = 0.00F},
       .hue = {.ripeness = {0.00F, 0.00F, 0.00F, 0.00F}, .warmth = 1.00F, .relief_accent = 0.35F}},
      {.id = forest,
       .name = "forest",
       .meaning = "upright trees",
       .rgb = 0x1e5a28,
       .stand_in = forest,
       .traits = drifts | desaturates | turf,
       .tone = {.detail = 0.45F, .edges = 0.10F, .ribs = 0.05F, .contrast = 1.20F, .lift = 0.00F},
       .hue = {.ripeness = {0.00F, 0.00F, 0.00F, 0.00F}, .warmth = 1.00F, .relief_accent = 0.35F}},
      {.id = alpine_grass,
       .name = "alpine_grass",
       .meaning = "grass above the treeline",
       .rgb = 0x96aa46,
       .stand_in = alpine_grass,
       .traits = open_high | bleaches | drifts | desaturates | turf | lone_trees | accents,
       .tone = {.detail = 0.45F, .edges = 0.07F, .ribs = 0.10F, .contrast = 1.00F, .lift = 0.00F},
       .hue = {.ripeness = {0.14F, 0.22F, 0.12F, -0.15F}, .warmth = 1.00F, .relief_accent = 0.35F}},
      {.id = scree,
       .name = "scree",
       .meaning = "loose stone",
       .rgb = 0xbeb4aa,
       .stand_in = scree,
       .traits = open_high | drifts | accents,
       .tone = {.detail = 0.60F, .edges = 0.07F, .ribs = 0.10F, .contrast = 1.00F, .lift = 0.00F},
       .hue = {.ripeness = {0.00F, 0.00F, 0.00F, 0.00F}, .warmth = 1.00F, .relief_accent = 0.60F}},
      {.id = rock,
       .name = "rock",
       .meaning = "walls, bare ground",
       .rgb = 0x6e646e,
       .stand_in = rock,
       .traits = open_high | own_relief | drifts | tight,
       .tone = {.detail = 0.68F, .edges = 0.10F, .ribs = 0.00F, .contrast = 1.45F, .lift = 0.00F},
       .hue = {.ripeness = {0.00F, 0.00F, 0.00F, 0.00F}, .warmth = 0.60F, .relief_accent = 0.90F}},
      {.id = snow,
       .name = "snow",
       .meaning = "snow fields",
       .rgb = 0xffffff,
       .stand_in = snow,
       .traits = open_high | tight | icy | accents,
       .tone = {.detail = 0.55F, .edges = 0.07F, .ribs = 0.10F, .contrast = 1.30F, .lift = 0.00F},
       .hue = {.ripeness = {0.00F, 0.00F, 0.00F, 0.00F}, .warmth = 0.40F, .relief_accent = 0.60F}},
      {.id = glacier,
       .name = "glacier",
       .meaning = "ice and perennial snow",
       .rgb = 0xb4e6ff,
       .stand_in = glacier,
       .traits = open_high | tight | icy | accents,
       .tone = {.detail = 0.38F, .edges = 0.05F, .ribs = 0.00F, .contrast = 1.20F, .lift = 0.00F},
       .hue = {.ripeness = {0.00F, 0.00F, 0.00F, 0.00F}, .warmth = 0.40F, .relief_accent = 0.60F}},
      {.id = pasture,
       .name = "pasture",
       .meaning = "grass on slopes below the treeline",
       .rgb = 0xb4d25a,
       .stand_in = pasture,
       .traits = bleaches | drifts | desaturates | gravel_banks | turf | lone_trees | accents,
       .tone = {.detail = 0.45F, .edges = 0.07F, .ribs = 0.00F, .contrast = 1.00F, .lift = 0.00F},
       .hue = {.ripeness = {0.12F, 0.20F, 0.12F, -0.15F}, .warmth = 1.00F, .relief_accent = 0.35F}},
      {.id = shrub,
       .name = "shrub",
       .meaning = "shrubland, heath, sagebrush",
       .rgb = 0x7d8246,
       .stand_in = shrub,
       .traits = open_high | bleaches | drifts | desaturates | turf | accents,
       .tone = {.detail = 0.45F, .edges = 0.09F, .ribs = 0.07F, .contrast = 1.05F, .lift = 0.00F},
       .hue = {.ripeness = {0.14F, 0.22F, 0.10F, -0.05F}, .warmth = 1.00F, .relief_accent = 0.35F}},
      {.id = sand,
       .name = "sand",
       .meaning = "beaches, dunes, river bars",
       .rgb = 0xf0d296,
       .stand_in = scree,
       .traits = drifts | level | accents,
       .tone = {.detail = 0.50F, .edges = 0.08F, .ribs = 0.00F, .contrast = 0.85F, .lift = 0.05F},
       .hue = {.ripeness = {0.00F, 0.00F, 0.00F, 0.00F}, .warmth = 1.00F, .relief_accent = 0.50F}},
  });
}();
inline constexpr int land_cover_class_count = static_cast<int>(land_cover_table.size());
static_assert(
    [] {
      for (std::size_t i = 0; i < land_cover_table.size(); ++i)
        if (static_cast<std::size_t>(land_cover_table[i].id) != i) return false;
      return true;
    }(),
    "the rows of land_cover_table must be in the order of ids");

// The id must be one of the classes.
constexpr const LandCoverClassInfo& class_info(LandCoverClass id) {
  return land_cover_table[static_cast<std::size_t>(id)];
}
constexpr bool has_trait(LandCoverClass id, ClassTrait trait) {
  return (static_cast<std::uint32_t>(class_info(id).traits) & static_cast<std::uint32_t>(trait)) !=
         0U;
}

// In the order of their ids.
constexpr const auto& land_cover_classes() { return land_cover_table; }
std::string_view class_name(LandCoverClass id);
std::optional<LandCoverClass> find_class(std::string_view name);
// Classes that ground can have: all but the sky.
std::optional<LandCoverClass> find_ground_class(std::string_view name);
std::vector<std::string> ground_class_names();

// Pairs of a class and the class it is copied from if no exemplar has it: as the scene sets, else
// by the stand-ins.
using ClassPairs = std::vector<std::pair<LandCoverClass, LandCoverClass>>;
ClassPairs with_stand_ins(ClassPairs fallback);

}  // namespace belvedere
