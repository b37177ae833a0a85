#include <fmt/core.h>

#include <algorithm>

#include "base/config.h"
#include "base/error.h"
#include "base/text/embedded.h"
#include "renderer/exemplar/available_texels.h"
#include "renderer/exemplar/texel_names.h"

namespace belvedere {
namespace {

std::size_t read_class_name(const std::string& word, const ConfigValue& at,
                            const std::string& name) {
  const auto id = find_class(word);
  if (!id || *id == LandCoverClass::sky)
    refuse_value(at, name, "the class \"" + word + "\"", "a land-cover class");
  return static_cast<std::size_t>(*id);
}

// "1.11": needed bins, one character per bin.
template <std::size_t count>
void read_flags(const ConfigValue& value, const std::string& name, std::array<bool, count>& flags) {
  const std::string& text = as_string(value, name);
  if (text.size() != count || text.find_first_not_of("1.") != std::string::npos)
    refuse_value(value, name, describe(value),
                 fmt::format("{} characters, 1 for needed and . for not needed", count));
  for (std::size_t i = 0; i < count; ++i) flags[i] = text[i] == '1';
}

}  // namespace

NeededTexels parse_needed_texels(std::string_view text, const std::string& name) {
  const ConfigValue root = parse_config(text, name);
  const ConfigTable& table = as_table(root, name);
  NeededTexels demand;
  for (const ConfigEntry& entry : table) {
    const std::size_t id = read_class_name(entry.key, entry.value, name);
    const ConfigTable& of_class = as_table(entry.value, name);
    demand.texels[id] = true;
    allow_only(of_class, {"light", "direction", "shadow", "border"}, name);
    if (const ConfigValue* light = find(of_class, "light")) {
      const ConfigArray& rows = as_array(*light, name);
      if (rows.size() != AvailableTexels::tones)
        refuse_value(*light, name, fmt::format("{} rows", rows.size()),
                     "one row for each of the five tones");
      for (std::size_t t = 0; t < rows.size(); ++t) read_flags(rows[t], name, demand.light[id][t]);
    }
    if (const ConfigValue* direction = find(of_class, "direction"))
      read_flags(*direction, name, demand.direction[id]);
    if (const ConfigValue* shadow = find(of_class, "shadow"))
      demand.shadow[id] = as_bool(*shadow, name);
    if (const ConfigValue* border = find(of_class, "border"))
      for (const ConfigValue& other : as_array(*border, name)) {
        const std::size_t beside = read_class_name(as_string(other, name), other, name);
        demand.border[id][beside] = demand.border[beside][id] = true;
      }
  }
  return demand;
}

const NeededTexels& built_in_needed_texels() {
  static const NeededTexels demand =
      parse_needed_texels(embedded_file("sheet/needed_texels.toml"), "sheet/needed_texels.toml");
  return demand;
}

std::string distance_name(std::size_t bin) {
  const auto km = [](float m) { return static_cast<int>(m / 1000.F); };
  const auto& bounds = AvailableTexels::distance_bounds_m;
  if (bin == 0) return fmt::format("nearer than {} km", km(bounds[0]));
  if (bin == bounds.size()) return fmt::format("beyond {} km", km(bounds.back()));
  return fmt::format("{}–{} km", km(bounds[bin - 1]), km(bounds[bin]));
}

std::string direction_name(std::size_t bin) {
  static constexpr std::array<const char*, AvailableTexels::directions> names = {
      "right", "down right", "down", "down left", "left", "up left", "up", "up right"};
  return names[bin];
}

std::string altitude_name(std::size_t bin) {
  const auto& bounds = AvailableTexels::altitude_bounds_m;
  if (bin == 0) return fmt::format("below {:.0f} m", bounds[0]);
  if (bin == bounds.size()) return fmt::format("above {:.0f} m", bounds.back());
  return fmt::format("{:.0f}–{:.0f} m", bounds[bin - 1], bounds[bin]);
}

}  // namespace belvedere
