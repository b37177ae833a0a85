#include "base/land_cover_class.h"

#include <algorithm>

namespace belvedere {

std::string_view class_name(LandCoverClass id) {
  return static_cast<std::size_t>(id) < land_cover_table.size() ? class_info(id).name
                                                                : std::string_view("unknown");
}

std::optional<LandCoverClass> find_class(std::string_view name) {
  for (const LandCoverClassInfo& info : land_cover_table)
    if (info.name == name) return info.id;
  return std::nullopt;
}

std::optional<LandCoverClass> find_ground_class(std::string_view name) {
  const std::optional<LandCoverClass> found = find_class(name);
  return found == LandCoverClass::sky ? std::nullopt : found;
}

std::vector<std::string> ground_class_names() {
  std::vector<std::string> names;
  for (const LandCoverClassInfo& info : land_cover_table)
    if (info.id != LandCoverClass::sky) names.emplace_back(info.name);
  return names;
}

ClassPairs with_stand_ins(ClassPairs fallback) {
  const ClassPairs said = fallback;
  for (const LandCoverClassInfo& info : land_cover_table) {
    const bool is_said = std::any_of(said.begin(), said.end(),
                                     [&](const auto& pair) { return pair.first == info.id; });
    if (info.stand_in != info.id && !is_said) fallback.emplace_back(info.id, info.stand_in);
  }
  return fallback;
}

}  // namespace belvedere
