#include "renderer/exemplar/available_texels.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/config.h"
#include "base/error.h"
#include "base/math_exact.h"
#include "base/text/embedded.h"
#include "base/text/json.h"

namespace belvedere {
namespace {

constexpr float same_surface_ratio =
    1.03F;                               // neighbours with a larger depth ratio lie on two surfaces
constexpr double counted_size = 4096.0;  // of the painting that the minimum counts refer to

template <std::size_t bounds>
std::size_t bin_of(float value, const std::array<float, bounds>& limits) {
  return static_cast<std::size_t>(std::upper_bound(limits.begin(), limits.end(), value) -
                                  limits.begin());
}

std::size_t tone_bin(float tone) {
  return static_cast<std::size_t>(
      std::clamp(static_cast<int>(tone * AvailableTexels::tones), 0, AvailableTexels::tones - 1));
}

std::size_t direction_bin(glm::vec2 direction) {
  const float turns = exact::atan2(direction.y, direction.x) / (2.F * std::numbers::pi_v<float>);
  const int bin = static_cast<int>(std::floor(turns * AvailableTexels::directions + 0.5F));
  return static_cast<std::size_t>((bin + AvailableTexels::directions) %
                                  AvailableTexels::directions);
}

bool same_surface(float a, float b) {
  return a <= same_surface_ratio * b && b <= same_surface_ratio * a;
}

}  // namespace

std::int64_t AvailableTexels::ground() const {
  return std::accumulate(texels.begin(), texels.end(), std::int64_t{0});
}

void add_available(AvailableTexels& available, const GuidanceBuffers& guidance,
                   const Grid<LandCoverClass>& classes) {
  using B = GuidanceBuffers;
  require_channels(guidance, {&B::depth_m, &B::tone, &B::fall_line, &B::altitude_m, &B::shadow},
                   "supply");
  const int width = guidance.width();
  const int height = guidance.height();
  available.pixels += static_cast<std::int64_t>(guidance.depth_m.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = classes.index(x, y);
      if (guidance.is_sky(i) || classes[i] == LandCoverClass::sky) continue;
      const auto id = static_cast<std::size_t>(classes[i]);
      const float depth = guidance.depth_m[i];
      ++available.texels[id];
      ++available.by_light[id][tone_bin(guidance.tone[i])]
                          [bin_of(depth, AvailableTexels::distance_bounds_m)];
      if (guidance.fall_line[i] != glm::vec2(0.F))
        ++available.by_direction[id][direction_bin(guidance.fall_line[i])];
      ++available
            .by_altitude[id][bin_of(guidance.altitude_m[i], AvailableTexels::altitude_bounds_m)];
      if (guidance.shadow[i] < 0.5F) ++available.in_cast_shadow[id];

      // A texel counts once for each other class around it.
      AvailableTexels::ByClass<bool> beside{};
      bool edge = false;
      const auto look = [&](int nx, int ny) {
        if (!classes.contains(nx, ny)) return;
        const float other = guidance.depth_m(nx, ny);
        if (other > same_surface_ratio * depth) edge = true;
        const auto its = static_cast<std::size_t>(classes(nx, ny));
        if (its != id && its != static_cast<std::size_t>(LandCoverClass::sky) &&
            same_surface(depth, other))
          beside[its] = true;
      };
      look(x - 1, y);
      look(x + 1, y);
      look(x, y - 1);
      look(x, y + 1);
      available.at_silhouette += edge ? 1 : 0;
      for (std::size_t k = 0; k < beside.size(); ++k) {
        if (!beside[k]) continue;
        ++available.border[id][k];
        ++available.border[k][id];
      }
    }
  }
}

std::vector<TexelShortage> find_gaps(const AvailableTexels& available, const NeededTexels& demand,
                                     const MinTexels& floors) {
  std::vector<TexelShortage> gaps;
  const double scale = static_cast<double>(available.pixels) / (counted_size * counted_size);
  const double length_scale =
      std::sqrt(scale);  // borders are lines: they scale with a painting's side
  const auto require = [&](bool needed, std::int64_t found, double floor, const auto& name) {
    if (needed && static_cast<double>(found) < floor)
      gaps.push_back({name(), static_cast<double>(found), floor});
  };
  for (int k = 1; k < land_cover_class_count; ++k) {
    const auto id = static_cast<std::size_t>(k);
    const std::string name(class_name(static_cast<LandCoverClass>(k)));
    require(demand.texels[id], available.texels[id], floors.texels * scale, [&] { return name; });
    const double max = floors.largest_share * static_cast<double>(available.ground());
    if (static_cast<double>(available.texels[id]) > max)
      gaps.push_back(
          {name + ", share of the ground", static_cast<double>(available.texels[id]), max, true});
    for (std::size_t t = 0; t < AvailableTexels::tones; ++t)
      for (std::size_t d = 0; d < AvailableTexels::distances; ++d)
        require(demand.light[id][t][d], available.by_light[id][t][d], floors.light * scale, [&] {
          return fmt::format("{}, tone {:.1f}–{:.1f}, {}", name, 0.2 * t, 0.2 * (t + 1),
                             distance_name(d));
        });
    for (std::size_t n = 0; n < AvailableTexels::directions; ++n)
      require(demand.direction[id][n], available.by_direction[id][n], floors.direction * scale,
              [&] { return fmt::format("{}, fall line {}", name, direction_name(n)); });
    require(demand.shadow[id], available.in_cast_shadow[id], floors.shadow * scale,
            [&] { return name + ", in cast shadow"; });
    for (std::size_t other = id + 1; other < static_cast<std::size_t>(land_cover_class_count);
         ++other)
      require(demand.border[id][other], available.border[id][other], floors.border * length_scale,
              [&] {
                return fmt::format("border of {} and {}", name,
                                   class_name(static_cast<LandCoverClass>(other)));
              });
  }
  const auto forest = static_cast<std::size_t>(LandCoverClass::forest);
  for (std::size_t a = 0; a < AvailableTexels::altitudes; ++a)
    require(true, available.by_altitude[forest][a], floors.altitude * scale,
            [&] { return "forest, " + altitude_name(a); });
  return gaps;
}

namespace {

std::size_t read_class_name(const std::string& word, const ConfigValue& at,
                            const std::string& name) {
  const auto id = find_ground_class(word);
  if (!id) refuse_value(at, name, "the class \"" + word + "\"", "a land-cover class");
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

namespace {

template <class Counts>
Json counts_json(const Counts& counts) {
  Json list = Json::array();
  for (const auto count : counts) list.add(Json::number(static_cast<double>(count)));
  return list;
}

// Thousands of texels, narrow enough for tables.
std::string thousands(std::int64_t count) {
  if (count == 0) return "·";
  if (count < 1000) return fmt::format("{:.2f}", static_cast<double>(count) / 1000.0);
  return fmt::format("{:.0f}", static_cast<double>(count) / 1000.0);
}

}  // namespace

std::string available_json(const AvailableTexels& available,
                           const std::vector<TexelShortage>& gaps) {
  Json classes = Json::object();
  for (int k = 1; k < land_cover_class_count; ++k) {
    const auto id = static_cast<std::size_t>(k);
    Json light = Json::array();
    for (const auto& row : available.by_light[id]) light.add(counts_json(row));
    Json border = Json::object();
    for (int other = 1; other < land_cover_class_count; ++other)
      if (available.border[id][static_cast<std::size_t>(other)] > 0)
        border.add(class_name(static_cast<LandCoverClass>(other)),
                   Json::number(
                       static_cast<double>(available.border[id][static_cast<std::size_t>(other)])));
    classes.add(
        class_name(static_cast<LandCoverClass>(k)),
        Json::object()
            .add("texels", Json::number(static_cast<double>(available.texels[id])))
            .add("in_cast_shadow", Json::number(static_cast<double>(available.in_cast_shadow[id])))
            .add("by_tone_and_distance", std::move(light))
            .add("by_direction", counts_json(available.by_direction[id]))
            .add("by_altitude", counts_json(available.by_altitude[id]))
            .add("border", std::move(border)));
  }
  Json lacking = Json::array();
  for (const TexelShortage& gap : gaps)
    lacking.add(Json::object()
                    .add("what", Json::text(gap.what))
                    .add("found", Json::number(gap.found))
                    .add(gap.too_much ? "at_most" : "wanted", Json::number(gap.needed)));
  return Json::object()
             .add("pixels", Json::number(static_cast<double>(available.pixels)))
             .add("ground", Json::number(static_cast<double>(available.ground())))
             .add("at_silhouette", Json::number(static_cast<double>(available.at_silhouette)))
             .add("tone_bounds", Json::array({Json::number(0.2), Json::number(0.4),
                                              Json::number(0.6), Json::number(0.8)}))
             .add("distance_bounds_m", counts_json(AvailableTexels::distance_bounds_m))
             .add("altitude_bounds_m", counts_json(AvailableTexels::altitude_bounds_m))
             .add("classes", std::move(classes))
             .add("gaps", std::move(lacking))
             .str() +
         "\n";
}

std::string available_text(const AvailableTexels& available, const std::vector<TexelShortage>& gaps,
                           bool judge) {
  const double ground = std::max(1.0, static_cast<double>(available.ground()));
  std::string out = fmt::format(
      "Thousands of texels, {:.2f} million in total; tones from dark to "
      "light\n\n{:14}{:>7}{:>7}{:>7}   {}\n",
      ground / 1e6, "class", "share", "all", "shadow", "tones at each distance");
  for (int k = 1; k < land_cover_class_count; ++k) {
    const auto id = static_cast<std::size_t>(k);
    out += fmt::format("{:14}{:6.1f}%{:>7}{:>7}  ", class_name(static_cast<LandCoverClass>(k)),
                       100.0 * static_cast<double>(available.texels[id]) / ground,
                       thousands(available.texels[id]), thousands(available.in_cast_shadow[id]));
    for (std::size_t d = 0; d < AvailableTexels::distances; ++d) {
      out += " |";
      for (std::size_t t = 0; t < AvailableTexels::tones; ++t)
        out += fmt::format("{:>5}", thousands(available.by_light[id][t][d]));
    }
    out += "\n";
  }
  out += "\nDistances: ";
  for (std::size_t d = 0; d < AvailableTexels::distances; ++d)
    out += (d == 0 ? "" : ", ") + distance_name(d);
  out += "\n";
  if (!judge) return out;
  if (gaps.empty()) return out + "All minimum counts are met.\n";
  out += fmt::format("\n{} minimum counts are not met:\n", gaps.size());
  for (const TexelShortage& gap : gaps)
    out += gap.too_much
               ? fmt::format("  {}: {:.0f}, at most {:.0f}\n", gap.what, gap.found, gap.needed)
               : fmt::format("  {}: {:.0f} of {:.0f}\n", gap.what, gap.found, gap.needed);
  return out;
}

}  // namespace belvedere
