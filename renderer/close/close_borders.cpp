#include "renderer/close/close_borders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"
#include "renderer/rock/rock_ground.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

// Displacements in units of the sheet: by the relief, and by broken noise of two sizes.
constexpr float by_tongues = 14.0F;
constexpr float by_teeth = 6.5F;
constexpr float on_glaciers = 0.6F;     // share of the tongues: ice has even margins
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
// Distances and shares of the ground around ice.
constexpr double ice_units = 5.0;  // deviations of its shares
constexpr double white_units = 13.0;
constexpr float bare_from = 0.10F;    // share of ice around from which turf gives way to rubble
constexpr float widest_gully = 8.0F;  // half of old snow in it, units
constexpr float narrowest_gully = 0.8F;
constexpr float border_limit = border_reach_units - 0.5F;

// Edges of forest are displaced by the tongues, too. They and those of turf follow broader noise as
// well: trees climb ribs, and copses and meadows lie beyond them.
constexpr float wood_tongues = 0.85F;
constexpr float wood_cell = 15.0F;
constexpr float wood_shift = 4.5F;
constexpr float copse_cell = 10.0F;

bool borders_forest(Class id) { return id == Class::forest || id == Class::scree || is_turf(id); }

bool mixes(Class a, Class b) {
  return (a == Class::scree && is_turf(b)) || (b == Class::scree && is_turf(a));
}

// A patch of ground that belongs to a place aside of it.
struct Outlier {
  bool found = false;
  glm::vec2 from{0.0F};  // offset of that place, units
};
Outlier outlier_at(std::uint64_t key, float cell, glm::vec2 position) {
  const glm::ivec2 own(static_cast<int>(std::floor(position.x / cell)),
                       static_cast<int>(std::floor(position.y / cell)));
  for (int y = own.y - 1; y <= own.y + 1; ++y)
    for (int x = own.x - 1; x <= own.x + 1; ++x) {
      const auto draw = [&](std::uint64_t k) {
        return static_cast<float>(random_uniform(key, x, y, k));
      };
      if (draw(0) > outlier_share) continue;
      const glm::vec2 centre((static_cast<float>(x) + draw(1)) * cell,
                             (static_cast<float>(y) + draw(2)) * cell);
      const float u = draw(3);
      const float radius = (0.5F + u * u) * cell / outlier_cell;
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

// Whether another class lies within a square of `reach` pixels around each.
Grid<std::uint8_t> mixed_ground(const Grid<Class>& land_cover, int reach) {
  const int width = land_cover.width();
  const int height = land_cover.height();
  Grid<std::uint8_t> in_rows(width, height, 0);
  Grid<std::uint8_t> mixed(width, height, 0);
  parallel_rows(height, [&](int y) {
    int last = -2 * reach;  // the last pixel that differs from the next or from the one below
    const auto differs = [&](int x) {
      const Class own = land_cover(x, y);
      return (x + 1 < width && land_cover(x + 1, y) != own) ||
             (y + 1 < height && land_cover(x, y + 1) != own);
    };
    for (int x = -reach; x < width; ++x) {
      const int ahead = x + reach;
      if (ahead < width && differs(ahead)) last = ahead;
      if (x >= 0 && last >= x - reach) in_rows(x, y) = 1;
    }
  });
  parallel_ranges(width, 64, [&](int begin, int end) {
    std::vector<int> last(static_cast<std::size_t>(end - begin), -2 * reach);
    for (int y = -reach; y < height; ++y)
      for (int x = begin; x < end; ++x) {
        int& latest = last[static_cast<std::size_t>(x - begin)];
        if (y + reach < height && in_rows(x, y + reach) != 0) latest = y + reach;
        if (y >= 0 && latest >= y - reach) mixed(x, y) = 1;
      }
  });
  return mixed;
}

// The class at a position of the wide view, units of the sheet, of those that `counts`: the largest
// share of the four pixels around on the surface at depth_m; `otherwise` where most do not count.
Class class_around(const SpurGround& ground, glm::vec2 position, float depth_m, Class otherwise,
                   bool (*counts)(Class)) {
  const WideView& wide = ground.wide;
  const auto factor = static_cast<float>(wide.factor);
  const glm::vec2 at = position * static_cast<float>(ground.pixels_per_unit) / factor - 0.5F;
  const glm::vec2 base(std::floor(at.x), std::floor(at.y));
  std::array<float, land_cover_table.size()> shares{};
  Class most = otherwise;
  float largest = 0.0F;
  float open = 0.0F;
  for (const int k : {0, 1, 2, 3}) {
    const glm::vec2 corner(k % 2, k / 2);
    const glm::vec2 near = 1.0F - glm::abs(base + corner - at);
    const glm::vec2 centre = (base + corner + 0.5F) * factor;
    const std::size_t i =
        wide.index(static_cast<int>(std::floor(centre.x)), static_cast<int>(std::floor(centre.y)));
    const Class id = wide.seen.land_cover[i];
    if (!counts(id) || !same_surface(wide.seen.depth_m[i], depth_m)) continue;
    float& share = shares[static_cast<std::size_t>(id)];
    share += near.x * near.y;
    open += near.x * near.y;
    if (share > largest) {
      largest = share;
      most = id;
    }
  }
  return open >= 0.5F ? most : otherwise;
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

IceAround look_around_ice(const SpurGround& ground, PixelRect sheet_rect) {
  const GuidanceBuffers& wide = ground.wide.seen;
  const PixelRect held{0, 0, wide.width(), wide.height()};
  const PixelRect read = moved(wide_rect(sheet_rect, ground.wide.factor), -ground.wide.origin_px.x,
                               -ground.wide.origin_px.y);
  const auto share = [&](double units, bool snow) {
    Grid<float> part(wide.width(), wide.height());
    for (std::size_t i = 0; i < part.size(); ++i)
      part[i] = wide.land_cover[i] == Class::glacier || (snow && wide.land_cover[i] == Class::snow)
                    ? 1.0F
                    : 0.0F;
    return blur_on_surface(part, wide.depth_m, units * ground.pixels_per_unit / ground.wide.factor,
                           intersection(held, grown(surface_look(read), 3)));
  };
  return {share(ice_units, false), share(white_units, true)};
}

int ice_around_reach(double pixels_per_unit, int factor) {
  return surface_reach_px(white_units * pixels_per_unit / factor) + surface_look_rows + 6;
}

CloseBorders make_close_borders(const GuidanceBuffers& guidance, const SpurGround& ground,
                                const IceAround& ice, glm::ivec2 origin_px, PixelRect sheet_rect,
                                std::uint64_t seed) {
  const auto down = [&](std::size_t i) { return std::optional(ground.fall[i]); };
  const auto reach =
      static_cast<int>(std::ceil(border_reach_units * ground.pixels_per_unit / ground.wide.factor));
  return {guidance,
          ground,
          origin_px,
          grow_roofs(ground, border_tongues, border_tongues_part, sheet_rect, down),
          grow_roofs(ground, border_teeth, border_teeth_part, sheet_rect, down),
          mixed_ground(ground.wide.seen.land_cover, reach + 1),
          ice,
          seed};
}

Class CloseBorders::at(int x, int y, float close) const {
  const GuidanceBuffers& g = guidance;
  const Class own = g.land_cover(x, y);
  if ((own != Class::forest && !is_open_ground(own)) || close <= 0.0F) return own;
  const WideView& wide = ground.wide;
  const std::size_t below = wide.index(origin_px.x + x, origin_px.y + y);
  // Within one class nothing changes: most pixels end here.
  if (mixed[below] == 0) return own;
  const glm::vec2 position{static_cast<float>((origin_px.x + x + 0.5) / ground.pixels_per_unit),
                           static_cast<float>((origin_px.y + y + 0.5) / ground.pixels_per_unit)};
  const float depth_m = g.depth_m(x, y);
  const auto noise = [&](std::uint64_t part, float cell) {
    return broken_noise(stream_seed(seed, Stream::close_borders, part), position.x / cell,
                        position.y / cell);
  };
  const auto height_of = [](const SpurHit& roof) {
    return roof.spur == nullptr ? 0.0F
                                : std::clamp(roof.height - middle_height, -max_height, max_height);
  };
  const SpurHit broad = highest_spur(tongues, border_tongues.slender, position, depth_m, 0);
  const SpurHit narrow = highest_spur(teeth, border_teeth.slender, position, depth_m, 0);
  const float unlike = std::clamp(
      0.85F +
          0.75F * static_cast<float>(gaussian_noise(stream_seed(seed, Stream::close_borders, 4),
                                                    static_cast<double>(position.x),
                                                    static_cast<double>(position.y), unlike_sigma)),
      least, most);
  const float tongue = by_tongues * height_of(broad);
  const float tooth = by_teeth * unlike * height_of(narrow) + coarse_shift * noise(0, coarse_cell) +
                      fine_shift * noise(1, fine_cell);
  const float aside = coarse_shift * noise(2, coarse_cell) + fine_shift * noise(3, fine_cell);
  const glm::vec2 fall = ground.fall[below];
  const glm::vec2 across{fall.y, -fall.x};
  const auto class_at = [&](glm::vec2 offset_units) {
    return class_around(ground, position + offset_units, depth_m, own, is_open_ground);
  };
  const auto within_limit = [](glm::vec2 offset) {
    const float length = std::sqrt(glm::dot(offset, offset));
    return length > border_limit ? offset * (border_limit / length) : offset;
  };
  const bool grown = borders_forest(own);
  glm::vec2 ragged(0.0F);
  if (grown) {
    const Outlier copse =
        outlier_at(stream_seed(seed, Stream::close_borders, 11), copse_cell, position);
    ragged = close * wood_shift * (noise(9, wood_cell) * fall + noise(10, wood_cell) * across) +
             copse.from;
    const glm::vec2 wood = close * ((wood_tongues * tongue + tooth) * fall + aside * across);
    const Class there =
        class_around(ground, position + within_limit(wood + ragged), depth_m, own, borders_forest);
    if (there == Class::forest || own == Class::forest) return there;
  }
  const auto shifted = [&](float share) {
    return (share * tongue + tooth) * fall + aside * across;
  };
  glm::vec2 shift = shifted(1.0F);
  Class shown = class_at(close * shift);
  if (shown == Class::glacier || own == Class::glacier) {
    shift = shifted(on_glaciers);
    shown = class_at(close * shift);
  }
  if (close < 0.5F || (shown != Class::scree && !is_turf(shown))) return shown;
  // Between turf and stones as well: cells of elevation data would leave round meadows.
  if (grown) {
    const Class there = class_at(within_limit(close * shift + ragged));
    if (mixes(shown, there)) shown = there;
  }
  const auto around = [&](const Grid<float>& share) {
    return value_on_surface(wide, share, origin_px.x + x, origin_px.y + y, depth_m);
  };
  // Ground that ice has left lies bare; snow lasts in the gullies around it.
  if (is_turf(shown) && around(ice.ice) > bare_from + 0.05F * noise(6, 2.0F * coarse_cell))
    return Class::scree;
  if (shown == Class::scree && broad.spur != nullptr) {
    const float lasts = smoothstep(0.08F, 0.50F, around(ice.white));
    const float from_gully =
        broad.over_next * border_tongues.spacing_units / (2.0F * broad.steepness);
    const float here = 0.7F + 0.45F * noise(7, 3.0F * coarse_cell) + 0.15F * noise(8, fine_cell);
    const float filled = widest_gully * lasts * here;
    if (filled > narrowest_gully && from_gully < filled) return Class::snow;
  }
  const Outlier outlier =
      outlier_at(stream_seed(seed, Stream::close_borders, 5), outlier_cell, position);
  if (!outlier.found) return shown;
  const Class strewn = class_at(within_limit(outlier.from + shift));
  return mixes(shown, strewn) ? strewn : shown;
}

}  // namespace belvedere
