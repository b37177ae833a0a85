#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace belvedere {

// The classes a panorama is painted in. A legend maps the codes of a land-cover raster to these; palettes and brushes
// exist for each. The numbers are written to guidance files and never change; new classes get new numbers.
enum class LandCoverClass : std::uint8_t {
  sky = 0,  // no terrain
  water = 1,
  valley_floor = 2,  // fields, meadows and parks of the valley bottom
  settlement = 3,
  forest = 4,
  alpine_grass = 5,  // above the treeline
  scree = 6,
  rock = 7,
  snow = 8,
  glacier = 9,
  pasture = 10,  // grass on slopes below the treeline
  shrub = 11,    // shrubland, heath, sagebrush
};

inline constexpr int land_cover_class_count = 12;

struct LandCoverClassInfo {
  LandCoverClass id;
  std::string_view name;  // as written in scenes, legends and file headers
  std::uint32_t rgb;      // 0xrrggbb, for class maps only; the painting's colours are in palettes
};

// In the order of their ids.
const std::array<LandCoverClassInfo, land_cover_class_count>& land_cover_classes();
std::string_view class_name(LandCoverClass id);
std::optional<LandCoverClass> find_class(std::string_view name);

}  // namespace belvedere
