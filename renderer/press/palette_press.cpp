#include "renderer/press/palette_press.h"

#include <fmt/core.h>

#include "renderer/image/icc/press_colour.h"

namespace belvedere {
namespace {

std::vector<PaletteColour> colours_of(const Palette& palette) {
  std::vector<PaletteColour> out;
  const auto add = [&](std::string where, glm::vec3 colour) {
    out.push_back({std::move(where), colour, {}, 0.0});
  };
  for (const LandCoverClassInfo& info : land_cover_classes())
    for (const ClassPalette::Stop& stop : palette.classes[static_cast<std::size_t>(info.id)].stops)
      for (std::size_t t = 0; t < ramp_tones.size(); ++t)
        add(fmt::format("{} at {:.0f} m, tone {}", info.name, stop.altitude_m, ramp_tones[t]),
            stop.ramp[t]);
  for (const auto& [height, colour] : palette.sky) add(fmt::format("sky at {}", height), colour);
  add("clouds in light", palette.cloud_light);
  add("clouds in shade", palette.cloud_shade);
  add("haze near", palette.haze_near);
  add("haze far", palette.haze_far);
  add("mist between ranges", palette.range_mist);
  for (std::size_t i = 0; i < palette.growth.leaves.size(); ++i)
    add(fmt::format("leaves {}", i + 1), palette.growth.leaves[i]);
  if (palette.growth.larch_share > 0.0) add("larches", palette.growth.larch);
  return out;
}

}  // namespace

std::vector<PaletteColour> print_palette(const Palette& palette,
                                         const std::vector<std::uint8_t>& press) {
  std::vector<PaletteColour> colours = colours_of(palette);
  Grid<glm::vec3> row(static_cast<int>(colours.size()), 1);
  for (std::size_t i = 0; i < colours.size(); ++i) row[i] = colours[i].colour;
  const ProofRows rows = SoftProof(press, {.device = {RenderingIntent::relative, false}}).make(row);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    colours[i].printed = rows.shown[i];
    colours[i].delta_e = rows.delta_e[i];
  }
  return colours;
}

}  // namespace belvedere
