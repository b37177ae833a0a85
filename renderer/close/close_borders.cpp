#include "renderer/close/close_borders.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/noise.h"
#include "base/random.h"
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
// Teeth of unlike size: a factor on the relief's, by broad noise.
constexpr double unlike_sigma = 24.0;
constexpr float least = 0.15F;
constexpr float most = 1.35F;
// Tufts beyond the edge of grass, stones before it: one to a cell at most.
constexpr float outlier_cell = 2.8F;
constexpr float outlier_share = 0.8F;
constexpr float outlier_reach = 15.0F;
constexpr float border_limit = border_reach_units - 0.5F;

bool is_grassy_class(Class id) {
  return id == Class::alpine_grass || id == Class::pasture || id == Class::shrub;
}
bool mixes(Class a, Class b) {
  return (a == Class::scree && is_grassy_class(b)) || (b == Class::scree && is_grassy_class(a));
}

// A patch of ground that belongs to a place aside of it.
struct Outlier {
  bool found = false;
  glm::vec2 from{0.0F};  // offset of that place, units
};
Outlier outlier_at(std::uint64_t key, glm::vec2 position) {
  const glm::ivec2 own(static_cast<int>(std::floor(position.x / outlier_cell)),
                       static_cast<int>(std::floor(position.y / outlier_cell)));
  for (int y = own.y - 1; y <= own.y + 1; ++y)
    for (int x = own.x - 1; x <= own.x + 1; ++x) {
      const auto draw = [&](std::uint64_t k) {
        return static_cast<float>(random_uniform(key, x, y, k));
      };
      if (draw(0) > outlier_share) continue;
      const glm::vec2 centre((static_cast<float>(x) + draw(1)) * outlier_cell,
                             (static_cast<float>(y) + draw(2)) * outlier_cell);
      const float u = draw(3);
      const float radius = 0.5F + u * u;
      glm::vec2 offset = position - centre;
      offset.x *= 0.75F;  // wider than high
      if (offset.x * offset.x + offset.y * offset.y > radius * radius) continue;
      const float away = outlier_reach * draw(4);
      const float aside = 2.0F * draw(5) - 1.0F;
      const float down = 2.0F * draw(6) - 1.0F;
      return {true, glm::vec2(aside, down) * away};
    }
  return {};
}

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
  const float unlike = std::clamp(
      0.85F +
          0.75F * static_cast<float>(gaussian_noise(stream_seed(seed, Stream::close_borders, 4),
                                                    static_cast<double>(position.x),
                                                    static_cast<double>(position.y), unlike_sigma)),
      least, most);
  const float down = by_relief * unlike * height + coarse_shift * noise(0, coarse_cell) +
                     fine_shift * noise(1, fine_cell);
  const float aside = coarse_shift * noise(2, coarse_cell) + fine_shift * noise(3, fine_cell);
  const glm::vec2 fall = ground.fall[ground.wide.index(origin_px.x + x, origin_px.y + y)];
  const glm::vec2 across{fall.y, -fall.x};
  const auto class_of = [&](glm::vec2 offset_units) {
    const std::size_t there = pixel_at(offset_units);
    return same_surface(g.depth_m[there], depth_m) && is_open_ground(g.land_cover[there])
               ? g.land_cover[there]
               : own;
  };
  const glm::vec2 shift = down * fall + aside * across;
  const Class shown = class_of(close * shift);
  if (close < 0.5F || (shown != Class::scree && !is_grassy_class(shown))) return shown;
  const Outlier outlier = outlier_at(stream_seed(seed, Stream::close_borders, 5), position);
  if (!outlier.found) return shown;
  const float length = std::sqrt(glm::dot(outlier.from + shift, outlier.from + shift));
  const float held = length > border_limit ? border_limit / length : 1.0F;
  const Class strewn = class_of(held * (outlier.from + shift));
  return mixes(shown, strewn) ? strewn : shown;
}

}  // namespace belvedere
