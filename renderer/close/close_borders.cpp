#include "renderer/close/close_borders.h"

#include <algorithm>
#include <cmath>

#include "base/random_streams.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

// Displacements in units of the sheet: by the relief, and by broken noise of two sizes.
constexpr float by_relief = 6.5F;
constexpr float middle_height = 0.75F;  // of the relief, in its spacings
constexpr float max_height = 0.7F;
constexpr float coarse_cell = 5.5F;
constexpr float fine_cell = 2.2F;
constexpr float coarse_shift = 1.4F;
constexpr float fine_shift = 0.35F;

}  // namespace

bool is_open_ground(Class id) {
  switch (id) {
    case Class::alpine_grass:
    case Class::pasture:
    case Class::shrub:
    case Class::scree:
    case Class::snow:
    case Class::glacier:
      return true;
    default:
      return false;
  }
}

Class CloseBorders::at(int x, int y, float close) const {
  const GuidanceBuffers& g = guidance;
  const Class own = g.land_cover(x, y);
  if (!is_open_ground(own) || close <= 0.0F) return own;
  // Within one class nothing changes: most pixels end here.
  const auto ppu = static_cast<float>(ground.pixels_per_unit);
  const auto pixel_at = [&](glm::vec2 offset_units) {
    const int there_x = x + static_cast<int>(std::floor(offset_units.x * ppu + 0.5F));
    const int there_y = y + static_cast<int>(std::floor(offset_units.y * ppu + 0.5F));
    return g.land_cover.index(std::clamp(there_x, 0, g.width() - 1),
                              std::clamp(there_y, 0, g.height() - 1));
  };
  bool uniform = true;
  for (const float reach : {2.5F, 5.5F, 8.5F})
    for (const glm::vec2 way : {glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(0, 1),
                                glm::vec2(0, -1), glm::vec2(0.7F, 0.7F), glm::vec2(-0.7F, 0.7F),
                                glm::vec2(0.7F, -0.7F), glm::vec2(-0.7F, -0.7F)})
      uniform = uniform && g.land_cover[pixel_at(way * reach)] == own;
  if (uniform) return own;
  const glm::vec2 position{static_cast<float>((origin_px.x + x + 0.5) / ground.pixels_per_unit),
                           static_cast<float>((origin_px.y + y + 0.5) / ground.pixels_per_unit)};
  const float depth_m = g.depth_m(x, y);
  const SpurHit roof = highest_spur(roofs, border_roofs.slender, position, depth_m, 0);
  const auto noise = [&](std::uint64_t part, float cell) {
    return broken_noise(stream_seed(seed, Stream::close_borders, part), position.x / cell,
                        position.y / cell);
  };
  const float height = roof.spur == nullptr
                           ? 0.0F
                           : std::clamp(roof.height - middle_height, -max_height, max_height);
  const float down =
      by_relief * height + coarse_shift * noise(0, coarse_cell) + fine_shift * noise(1, fine_cell);
  const float aside = coarse_shift * noise(2, coarse_cell) + fine_shift * noise(3, fine_cell);
  const glm::vec2 fall = ground.fall[ground.wide.index(origin_px.x + x, origin_px.y + y)];
  const glm::vec2 across{fall.y, -fall.x};
  const std::size_t there = pixel_at(close * (down * fall + aside * across));
  if (!same_surface(g.depth_m[there], depth_m)) return own;
  return is_open_ground(g.land_cover[there]) ? g.land_cover[there] : own;
}

}  // namespace belvedere
