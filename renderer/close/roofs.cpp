#include "renderer/close/roofs.h"

#include <cmath>
#include <utility>
#include <vector>

#include "base/random.h"

namespace belvedere {
namespace {

constexpr float tolerance_share = 0.003F;  // of the depth …
constexpr float tolerance_slope = 4.5F;    // … and metres a metre of ground
constexpr float aside_units = 4.0F;        // how far aside positions are looked up

Spur grow_roof(const SpurGround& ground, const RoofSize& size, std::uint64_t key, glm::ivec2 cell,
               FunctionRef<std::optional<glm::vec2>(std::size_t)> direction) {
  std::uint64_t draws = 0;
  const auto between = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random_uniform(key, cell.x, cell.y, draws++));
  };
  Spur roof;
  roof.position.x = (static_cast<float>(cell.x) + between(0.05F, 0.95F)) * size.spacing_units;
  roof.position.y = (static_cast<float>(cell.y) + between(0.05F, 0.95F)) * size.spacing_units;
  const auto ppu = static_cast<float>(ground.pixels_per_unit);
  const int x = static_cast<int>(std::floor(roof.position.x * ppu));
  const int y = static_cast<int>(std::floor(roof.position.y * ppu));
  if (!ground.wide.holds(x, y)) return roof;
  const std::size_t i = ground.wide.index(x, y);
  if (ground.wide.seen.is_sky(i)) return roof;
  const std::optional<glm::vec2> down = direction(i);
  if (!down) return roof;
  roof.grown = true;
  roof.id = static_cast<std::uint32_t>(random_bits(key, cell.x, cell.y, draws++)) | 1U;
  roof.top = between(0.0F, 0.8F);
  roof.flank[0] = between(0.7F, 1.6F);
  roof.flank[1] = between(0.7F, 1.6F);
  roof.length = between(0.5F, 1.5F);
  roof.foot = between(0.7F, 1.6F);
  roof.skew_foot = between(-0.35F, 0.35F);
  roof.skew_head = between(-0.35F, 0.35F);
  const float turn =
      size.lean_rad * static_cast<float>(random_normal(key, cell.x, cell.y, draws++));
  // A turn by its tangent: the machine's sine differs between machines.
  const glm::vec2 turned = *down + turn * glm::vec2(down->y, -down->x);
  roof.down = turned / std::sqrt(turned.x * turned.x + turned.y * turned.y);
  roof.fall = *down;
  roof.normal = ground.wide.seen.normal[i];
  roof.depth_m = ground.wide.seen.depth_m[i];
  const float metres_per_unit =
      ground.wide.seen.footprint_m[i] * ppu / static_cast<float>(ground.wide.factor);
  roof.tolerance_m =
      metres_per_unit * size.spacing_units * tolerance_slope + tolerance_share * roof.depth_m;
  return roof;
}

}  // namespace

SpurCells grow_roofs(const SpurGround& ground, const RoofSize& size, std::uint64_t part,
                     PixelRect rect, FunctionRef<std::optional<glm::vec2>(std::size_t)> direction) {
  using spur_form::max_reach;
  const std::uint64_t key = stream_seed(ground.seed, Stream::close_roofs, part);
  SpurCells cells;
  cells.spacing = size.spacing_units;
  cells.any_direction = true;
  const auto cell_of = [&](int px, float aside) {
    return static_cast<int>(
        std::floor((static_cast<float>(px / ground.pixels_per_unit) + aside) / size.spacing_units));
  };
  cells.first =
      glm::ivec2(cell_of(rect.x0, -aside_units), cell_of(rect.y0, -aside_units)) - max_reach;
  cells.count = glm::ivec2(cell_of(rect.x1, aside_units), cell_of(rect.y1, aside_units)) +
                (max_reach + 1) - cells.first;
  std::vector<Spur> roofs(static_cast<std::size_t>(cells.count.x) *
                          static_cast<std::size_t>(cells.count.y));
  parallel_rows(cells.count.y, [&](int y) {
    for (int x = 0; x < cells.count.x; ++x)
      roofs[static_cast<std::size_t>(y) * static_cast<std::size_t>(cells.count.x) +
            static_cast<std::size_t>(x)] =
          grow_roof(ground, size, key, cells.first + glm::ivec2(x, y), direction);
  });
  cells.spurs = std::move(roofs);
  cells.lanes = to_lanes(cells);
  return cells;
}

float roof_reach_units(const RoofSize& size) {
  return (static_cast<float>(spur_form::max_reach) + 1.0F) * size.spacing_units + aside_units;
}

}  // namespace belvedere
