#include "renderer/paint/rock_kinds.h"

#include <fmt/core.h>

#include <glm/common.hpp>
#include <string>

#include "base/error.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr float hue_strength =
    0.75F;  // factor on the hues below: at full strength a wall is a patchwork

const RockKind all_kinds[] = {
    {.name = "limestone",
     .meaning = "towers and buttresses, beds from gully to gully, pale",
     .size = 1.0F,
     .slender = 0.50F,
     .feather = 0.42F,
     .tilt = {0.60F, 0.38F, 0.26F},
     .beds = 1.0F,
     .bed_mm = 9.0F,
     .through = 0.35F,
     .tread = 0.55F,
     .diagonals = 1.0F,
     .cones = 1.0F,
     .hues = {{{{1.015F, 1.005F, 0.975F}, 0.32F},
               {{1.05F, 0.975F, 0.925F}, 0.48F},
               {{0.99F, 0.985F, 0.97F}, 0.68F},
               {{0.955F, 0.985F, 1.03F}, 0.84F},
               {{1.0F, 0.915F, 0.82F}, 0.91F},
               {{1.02F, 0.97F, 0.985F}, 1.0F}}}},
    {.name = "granite",
     .meaning = "slabs, cracks and sharp ridges, granite and gneiss, grey",
     .size = 1.25F,
     .slender = 0.55F,
     .feather = 0.30F,
     .tilt = {0.58F, 0.44F, 0.18F},
     .beds = 0.15F,
     .bed_mm = 12.0F,
     .through = 0.0F,
     .tread = 0.40F,
     .diagonals = 1.6F,
     .cones = 0.8F,
     .hues = {{{{0.985F, 0.985F, 0.98F}, 0.34F},
               {{1.01F, 0.98F, 0.95F}, 0.50F},
               {{0.95F, 0.965F, 0.97F}, 0.72F},
               {{0.93F, 0.965F, 1.0F}, 0.88F},
               {{0.95F, 0.90F, 0.83F}, 0.94F},
               {{0.96F, 0.975F, 0.93F}, 1.0F}}}},
    {.name = "sandstone",
     .meaning = "walls and benches in continuous beds, red and ochre",
     .size = 1.1F,
     .slender = 0.75F,
     .feather = 0.18F,
     .tilt = {0.48F, 0.34F, 0.22F},
     .beds = 1.7F,
     .bed_mm = 6.5F,
     .through = 0.92F,
     .tread = 0.75F,
     .diagonals = 0.3F,
     .cones = 0.7F,
     .hues = {{{{1.02F, 0.98F, 0.94F}, 0.30F},
               {{1.06F, 0.95F, 0.87F}, 0.55F},
               {{1.0F, 0.985F, 0.96F}, 0.70F},
               {{0.97F, 0.94F, 0.95F}, 0.82F},
               {{0.94F, 0.83F, 0.74F}, 0.92F},
               {{1.05F, 1.03F, 0.97F}, 1.0F}}}},
    {.name = "volcanic",
     .meaning = "ribs down from the summit with much debris between them, dark and brown",
     .size = 0.85F,
     .slender = 0.36F,
     .feather = 0.25F,
     .tilt = {0.52F, 0.42F, 0.28F},
     .beds = 0.35F,
     .bed_mm = 7.0F,
     .through = 0.5F,
     .tread = 0.45F,
     .diagonals = 0.2F,
     .cones = 1.7F,
     .hues = {{{{0.96F, 0.94F, 0.92F}, 0.30F},
               {{0.98F, 0.90F, 0.82F}, 0.50F},
               {{0.92F, 0.92F, 0.93F}, 0.74F},
               {{0.90F, 0.93F, 0.98F}, 0.86F},
               {{0.96F, 0.84F, 0.76F}, 0.95F},
               {{0.94F, 0.89F, 0.92F}, 1.0F}}}},
};

float share_of(std::uint32_t half) {
  return static_cast<float>(mix_bits(half + 0x51ed27U) & 0xffffU) / 65536.0F;
}

}  // namespace

std::span<const RockKind> rock_kinds() { return all_kinds; }

const RockKind& find_rock_kind(std::string_view name) {
  std::string known;
  for (const RockKind& kind : all_kinds) {
    if (kind.name == name) return kind;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", kind.name);
  }
  throw Error(ErrorKind::input, "kind of rock", fmt::format("\"{}\"", name), known);
}

glm::vec3 rock_hue(const RockKind& kind, std::uint32_t facet, float shade) {
  const float region = share_of(facet >> 16U);
  const float own = share_of(facet & 0xffffU);
  const float drawn = 0.30F * own + 0.70F * region;
  std::size_t k = 0;
  while (k + 1 < kind.hues.size() && drawn > kind.hues[k].up_to) ++k;
  const glm::vec3 hue = glm::mix(glm::vec3(1.0F), kind.hues[k].factor, hue_strength);
  const float violet = share_of(facet ^ 0x5bd1e995U) - 0.5F;
  return hue * (1.0F + shade * violet * glm::vec3(0.17F, -0.02F, 0.00F));
}

}  // namespace belvedere
