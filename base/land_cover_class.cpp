#include "base/land_cover_class.h"

namespace belvedere {

const std::array<LandCoverClassInfo, land_cover_class_count>& land_cover_classes() {
  using enum LandCoverClass;
  static const std::array<LandCoverClassInfo, land_cover_class_count> classes = {{
      {sky, "sky", 0xc8dcff},
      {water, "water", 0x285ac8},
      {valley_floor, "valley_floor", 0xe6dc6e},
      {settlement, "settlement", 0xc83c3c},
      {forest, "forest", 0x1e5a28},
      {alpine_grass, "alpine_grass", 0x96aa46},
      {scree, "scree", 0xbeb4aa},
      {rock, "rock", 0x6e646e},
      {snow, "snow", 0xffffff},
      {glacier, "glacier", 0xb4e6ff},
      {pasture, "pasture", 0xb4d25a},
      {shrub, "shrub", 0x7d8246},
  }};
  return classes;
}

std::string_view class_name(LandCoverClass id) {
  const auto i = static_cast<std::size_t>(id);
  return i < land_cover_classes().size() ? land_cover_classes()[i].name : std::string_view("unknown");
}

std::optional<LandCoverClass> find_class(std::string_view name) {
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (info.name == name) return info.id;
  return std::nullopt;
}

}  // namespace belvedere
