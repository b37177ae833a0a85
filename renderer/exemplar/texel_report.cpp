#include <fmt/core.h>

#include <algorithm>

#include "base/text/json.h"
#include "renderer/exemplar/available_texels.h"
#include "renderer/exemplar/texel_names.h"

namespace belvedere {
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
