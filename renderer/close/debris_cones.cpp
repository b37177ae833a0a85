#include "renderer/close/debris_cones.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <optional>
#include <utility>

#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"
#include "renderer/rock/rock_ground.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

// Parts of the random stream of close forms; smaller numbers belong to roofs.
constexpr std::uint64_t cones_part = 40;
constexpr std::uint64_t streaks_part = 41;
constexpr float seed_cell = 13.0F;    // units: spacing of positions that look for a gully
constexpr float bucket_cell = 16.0F;  // units
constexpr float up_step = 2.0F;       // of the way up to the wall, units
constexpr int up_steps = 8;
constexpr float slide = 4.0F;   // along the foot of the wall, units a step
constexpr int slides = 4;       // to each side
constexpr float apart = 15.0F;  // minimum distance of two apices, units
constexpr float down_step = 4.0F;
constexpr float shortest = 30.0F;  // less are wisps
constexpr float longest = 130.0F;
constexpr float highest_wall = 80.0F;  // that is measured, units
constexpr float widest = 0.62F;        // half width at the foot, in lengths
constexpr float level_z = 0.985F;      // of a normal: the slope ends below 10°
constexpr float steepest_z = 0.70F;    // debris does not lie above 45°
constexpr float min_down = 0.15F;      // slopes that face away are not seen
constexpr float tolerance_slope_cone = 4.5F;
constexpr float tolerance_share_cone = 0.003F;
constexpr float above_apex = 0.12F;   // lengths of a cone that lie in its gully
constexpr float head_width = 0.055F;  // half width at the apex, in lengths
constexpr float foot_lobes = 0.13F;
constexpr float ragged = 0.16F;  // of its sides, in half widths
constexpr float convex = 0.75F;  // gradient at its sides
constexpr float channel_depth = 0.7F;
constexpr float beside_units = 4.0F;  // of darker ground around it

bool takes_debris(Class id) { return id == Class::scree || is_turf(id); }

// The wide pixel under a position of the sheet in units.
std::optional<std::size_t> wide_at(const SpurGround& ground, glm::vec2 position) {
  const auto ppu = static_cast<float>(ground.pixels_per_unit);
  const int x = static_cast<int>(std::floor(position.x * ppu));
  const int y = static_cast<int>(std::floor(position.y * ppu));
  if (!ground.wide.holds(x, y)) return std::nullopt;
  const std::size_t i = ground.wide.index(x, y);
  if (ground.wide.seen.is_sky(i)) return std::nullopt;
  return i;
}

// The place on the foot of the wall above a position of debris, or below one of rock.
std::optional<glm::vec2> foot_of_wall(const SpurGround& ground, glm::vec2 position, float depth_m) {
  const GuidanceBuffers& seen = ground.wide.seen;
  const auto start = wide_at(ground, position);
  if (!start || !same_surface(seen.depth_m[*start], depth_m)) return std::nullopt;
  const bool in_rock = seen.land_cover[*start] == Class::rock;
  if (!in_rock && !takes_debris(seen.land_cover[*start])) return std::nullopt;
  std::size_t here = *start;
  for (int k = 0; k < up_steps; ++k) {
    const glm::vec2 next = position + ground.fall[here] * (in_rock ? up_step : -up_step);
    const auto there = wide_at(ground, next);
    if (!there || !same_surface(seen.depth_m[*there], seen.depth_m[here])) return std::nullopt;
    const Class id = seen.land_cover[*there];
    if (in_rock && takes_debris(id)) return next;
    if (!in_rock && id == Class::rock) return position;
    if (id != Class::rock && !takes_debris(id)) return std::nullopt;
    position = next;
    here = *there;
  }
  return std::nullopt;
}

// How much the wall gathers its debris above a position at its foot.
float gathers(const SpurGround& ground, glm::vec2 foot, std::size_t i) {
  constexpr float up = 7.0F;
  constexpr float aside = 6.0F;
  const glm::vec2 fall = ground.fall[i];
  const glm::vec2 across{fall.y, -fall.x};
  const glm::vec2 above = foot - fall * up;
  float converging = 0.0F;
  const auto left = wide_at(ground, above - across * aside);
  const auto right = wide_at(ground, above + across * aside);
  if (left && right) converging = glm::dot(ground.fall[*left] - ground.fall[*right], across);
  return 2.0F * converging - funnel_at(ground.seed, above);
}

struct Fall {
  float length = 0.0F;
  glm::vec2 middle{0.0F}, end{0.0F};
};

// The way of debris down from an apex.
Fall way_down(const SpurGround& ground, glm::vec2 apex, std::size_t i, float wanted) {
  const GuidanceBuffers& seen = ground.wide.seen;
  Fall way;
  std::array<glm::vec2, static_cast<std::size_t>(longest / down_step) + 2> places{};
  std::size_t count = 0;
  places[count++] = apex;
  glm::vec2 position = apex;
  std::size_t here = i;
  float level = 0.0F;
  while (static_cast<float>(count) * down_step <= wanted) {
    position += ground.fall[here] * down_step;
    const auto there = wide_at(ground, position);
    if (!there || !same_surface(seen.depth_m[*there], seen.depth_m[here]) ||
        !takes_debris(seen.land_cover[*there]))
      break;
    here = *there;
    places[count++] = position;
    if (seen.normal[here].z > level_z) level += down_step;
    if (level > 10.0F) break;
  }
  way.length = static_cast<float>(count - 1) * down_step;
  way.end = places[count - 1];
  way.middle = places[(count - 1) / 2];
  return way;
}

// Rock above an apex, units up its fall line.
float wall_above(const SpurGround& ground, glm::vec2 apex, std::size_t i) {
  const GuidanceBuffers& seen = ground.wide.seen;
  glm::vec2 position = apex;
  std::size_t here = i;
  for (float up = 0.0F; up < highest_wall; up += down_step) {
    position -= ground.fall[here] * down_step;
    const auto there = wide_at(ground, position);
    if (!there || !same_surface(seen.depth_m[*there], seen.depth_m[here])) return up;
    if (seen.land_cover[*there] != Class::rock && up > down_step) return up;
    here = *there;
  }
  return highest_wall;
}

DebrisCone grow_cone(const SpurGround& ground, std::uint64_t key, glm::ivec2 cell, float amount) {
  std::uint64_t draws = 0;
  const auto between = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random_uniform(key, cell.x, cell.y, draws++));
  };
  DebrisCone cone;
  glm::vec2 start;
  start.x = (static_cast<float>(cell.x) + between(0.0F, 1.0F)) * seed_cell;
  start.y = (static_cast<float>(cell.y) + between(0.0F, 1.0F)) * seed_cell;
  const GuidanceBuffers& seen = ground.wide.seen;
  const auto first = wide_at(ground, start);
  if (!first || !takes_debris(seen.land_cover[*first]) || seen.fall_line[*first].y < min_down)
    return cone;
  const float depth_m = seen.depth_m[*first];
  const auto foot = foot_of_wall(ground, start, depth_m);
  if (!foot) return cone;
  // Along the foot of the wall to the mouth of the nearest gully.
  const glm::vec2 fall = ground.fall[*first];
  const glm::vec2 across{fall.y, -fall.x};
  float most = -1e9F;
  for (int k = -slides; k <= slides; ++k) {
    const auto there =
        foot_of_wall(ground, *foot + across * (slide * static_cast<float>(k)), depth_m);
    if (!there) continue;
    const auto i = wide_at(ground, *there);
    if (!i) continue;
    const float gathered = gathers(ground, *there, *i);
    if (gathered <= most) continue;
    most = gathered;
    cone.apex = *there;
  }
  const float drawn = between(0.0F, 1.0F);
  const auto i = wide_at(ground, cone.apex);
  if (!i || most < -0.3F || seen.normal[*i].z < steepest_z) return cone;
  const float kept = std::min(amount, 1.0F);
  if (between(0.0F, 1.0F) > kept * kept) return cone;
  // A low wall has little to give.
  const float wanted =
      std::min((shortest + (longest - shortest) * (0.25F + 0.75F * drawn)) * (0.4F + 0.6F * kept),
               12.0F + 1.1F * wall_above(ground, cone.apex, *i));
  const Fall way = way_down(ground, cone.apex, *i, wanted);
  if (way.length < shortest) return cone;
  const glm::vec2 axis = way.end - cone.apex;
  cone.length = std::sqrt(axis.x * axis.x + axis.y * axis.y);
  if (cone.length < 0.7F * way.length) return cone;
  cone.down = axis / cone.length;
  const glm::vec2 right{cone.down.y, -cone.down.x};
  cone.bow = std::clamp(glm::dot(way.middle - 0.5F * (cone.apex + way.end), right),
                        -0.2F * cone.length, 0.2F * cone.length);
  cone.spread = between(0.30F, widest);
  cone.top = between(0.0F, 0.5F) + 0.25F * std::clamp(most, 0.0F, 2.0F);
  cone.depth_m = seen.depth_m[*i];
  const float metres_per_unit = seen.footprint_m[*i] * static_cast<float>(ground.pixels_per_unit) /
                                static_cast<float>(ground.wide.factor);
  cone.tolerance_m = metres_per_unit * tolerance_slope_cone;
  cone.id = static_cast<std::uint32_t>(random_bits(key, cell.x, cell.y, draws++)) | 1U;
  cone.channel_count = 2 + static_cast<int>(between(0.0F, 3.99F));
  for (int k = 0; k < cone.channel_count; ++k) {
    DebrisChannel& channel = cone.channels[static_cast<std::size_t>(k)];
    const float slot =
        (static_cast<float>(k) + between(0.15F, 0.85F)) / static_cast<float>(cone.channel_count);
    channel.at = 1.7F * slot - 0.85F;
    channel.from = between(0.0F, 0.20F);
    channel.to = between(0.35F, 0.95F);
  }
  return cone;
}

// A cone in its own coordinates.
struct Place {
  float v;      // along
  float e;      // across
  float width;  // units
};
Place place_on_cone(const DebrisCone& cone, glm::vec2 position) {
  const glm::vec2 offset = position - cone.apex;
  Place p{};
  p.v = glm::dot(offset, cone.down) / cone.length;
  const float held = std::clamp(p.v, 0.0F, 1.2F);
  p.width = cone.length * (head_width + (cone.spread - head_width) * std::min(1.0F, held) *
                                            (0.55F + 0.45F * std::min(1.0F, held)));
  const float u = offset.x * cone.down.y - offset.y * cone.down.x -
                  cone.bow * 4.0F * unit(p.v) * (1.0F - unit(p.v));
  p.e = u / p.width;
  return p;
}

}  // namespace

DebrisCones grow_debris_cones(const SpurGround& ground, PixelRect rect, float amount) {
  const std::uint64_t key = stream_seed(ground.seed, Stream::close_roofs, cones_part);
  DebrisCones grown;
  if (rect.empty()) return grown;
  const auto unit_of = [&](int px) { return static_cast<float>(px / ground.pixels_per_unit); };
  const auto cell_of = [](float units, float size) {
    return static_cast<int>(std::floor(units / size));
  };
  const float seeds_reach = longest * 1.2F + slide * slides + up_step * (2 * up_steps) + apart;
  const glm::ivec2 low(cell_of(unit_of(rect.x0) - seeds_reach, seed_cell),
                       cell_of(unit_of(rect.y0) - seeds_reach, seed_cell));
  const glm::ivec2 high(cell_of(unit_of(rect.x1) + seeds_reach, seed_cell),
                        cell_of(unit_of(rect.y1) + seeds_reach, seed_cell));
  const glm::ivec2 size = high - low + 1;
  std::vector<DebrisCone> all(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  parallel_rows(size.y, [&](int y) {
    for (int x = 0; x < size.x; ++x)
      all[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
          static_cast<std::size_t>(x)] = grow_cone(ground, key, low + glm::ivec2(x, y), amount);
  });
  std::erase_if(all, [](const DebrisCone& cone) { return cone.id == 0; });
  // Of two cones at one mouth, the higher remains.
  const auto yields = [&](const DebrisCone& cone) {
    return std::any_of(all.begin(), all.end(), [&](const DebrisCone& other) {
      const glm::vec2 offset = other.apex - cone.apex;
      return other.id != cone.id && glm::dot(offset, offset) < apart * apart &&
             std::pair(other.top, other.id) > std::pair(cone.top, cone.id);
    });
  };
  std::copy_if(all.begin(), all.end(), std::back_inserter(grown.cones),
               [&](const DebrisCone& cone) { return !yields(cone); });
  constexpr float aside = 4.0F;  // how far aside positions are looked up
  grown.first = {cell_of(unit_of(rect.x0) - aside, bucket_cell),
                 cell_of(unit_of(rect.y0) - aside, bucket_cell)};
  grown.count = glm::ivec2(cell_of(unit_of(rect.x1) + aside, bucket_cell),
                           cell_of(unit_of(rect.y1) + aside, bucket_cell)) +
                1 - grown.first;
  grown.cells.resize(static_cast<std::size_t>(grown.count.x) *
                     static_cast<std::size_t>(grown.count.y));
  for (std::size_t k = 0; k < grown.cones.size(); ++k) {
    const DebrisCone& cone = grown.cones[k];
    const float half = cone.length * (1.2F * cone.spread + 0.2F);
    const glm::vec2 a = cone.apex - cone.down * (above_apex * cone.length);
    const glm::vec2 b = cone.apex + cone.down * (1.2F * cone.length);
    const glm::ivec2 from(cell_of(std::min(a.x, b.x) - half, bucket_cell),
                          cell_of(std::min(a.y, b.y) - half, bucket_cell));
    const glm::ivec2 to(cell_of(std::max(a.x, b.x) + half, bucket_cell),
                        cell_of(std::max(a.y, b.y) + half, bucket_cell));
    for (int y = std::max(from.y - grown.first.y, 0);
         y <= std::min(to.y - grown.first.y, grown.count.y - 1); ++y)
      for (int x = std::max(from.x - grown.first.x, 0);
           x <= std::min(to.x - grown.first.x, grown.count.x - 1); ++x)
        grown
            .cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(grown.count.x) +
                   static_cast<std::size_t>(x)]
            .push_back(static_cast<std::uint32_t>(k));
  }
  return grown;
}

float debris_cones_reach_units() {
  // From a position to the farthest apex, and from there down its way or up its wall.
  return 2.2F * longest + apart + 24.0F + 0.5F * highest_wall;
}

DebrisHit debris_at(const DebrisCones& cones, std::uint64_t seed, glm::vec2 position,
                    float depth_m) {
  DebrisHit hit;
  const glm::ivec2 cell = glm::ivec2(static_cast<int>(std::floor(position.x / bucket_cell)),
                                     static_cast<int>(std::floor(position.y / bucket_cell))) -
                          cones.first;
  if (cell.x < 0 || cell.y < 0 || cell.x >= cones.count.x || cell.y >= cones.count.y) return hit;
  const std::uint64_t key = stream_seed(seed, Stream::close_roofs, streaks_part);
  float highest = -1e9F;
  float next = -1e9F;
  Place best{};
  for (const std::uint32_t k :
       cones.cells[static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(cones.count.x) +
                   static_cast<std::size_t>(cell.x)]) {
    const DebrisCone& cone = cones.cones[k];
    const Place p = place_on_cone(cone, position);
    if (p.v < -above_apex || p.v > 1.3F || std::abs(p.e) > 2.2F) continue;
    if (std::abs(depth_m - cone.depth_m) >
        tolerance_share_cone * depth_m + cone.tolerance_m * (4.0F + std::abs(p.v) * cone.length))
      continue;
    const float own = static_cast<float>(cone.id % 97U);
    const float foot =
        1.0F + foot_lobes * broken_noise(key, 3.0F * p.e + own, own) - 0.22F * p.e * p.e;
    const float side = 1.0F + ragged * unit(4.0F * p.v) *
                                  broken_noise(key, 9.0F * p.v + own, p.e > 0.0F ? own : -own);
    const float within = std::min((foot - p.v) * cone.length, (side - std::abs(p.e)) * p.width);
    if (within < 0.0F) {
      hit.beside = std::max(hit.beside, unit(1.0F + within / beside_units) * unit(8.0F * p.v));
      continue;
    }
    const float height = cone.top + 0.9F * (1.0F - p.e * p.e) - 0.3F * unit(p.v);
    if (height <= highest) {
      next = std::max(next, height);
      continue;
    }
    next = highest;
    highest = height;
    best = p;
    hit.cone = &cone;
    hit.inside = unit(within / 2.0F);
  }
  if (hit.cone == nullptr) return hit;
  const DebrisCone& cone = *hit.cone;
  hit.along = best.v;
  hit.across = best.e;
  hit.half_width = best.width;
  hit.over_next = highest - next;
  const glm::vec2 right{cone.down.y, -cone.down.x};
  const float own = static_cast<float>(cone.id % 97U) * 3.7F;
  float across = -convex * best.e * smoothstep(-0.05F, 0.12F, best.v);
  // Streaks from the apex, as broad as a dab at least.
  float tone =
      0.12F *
          broken_noise(key, 0.22F * best.e * cone.spread * cone.length + own, 2.2F * best.v + own) +
      0.045F * broken_noise(key, 0.55F * best.e * cone.spread * cone.length - own, 4.0F * best.v);
  for (int k = 0; k < cone.channel_count; ++k) {
    const DebrisChannel& channel = cone.channels[static_cast<std::size_t>(k)];
    if (best.v > channel.to + 0.2F) continue;
    const float branch = static_cast<float>(k) * 9.3F + own;
    const float way =
        channel.at * smoothstep(channel.from, channel.from + 0.40F, best.v) +
        0.10F * broken_noise(key, 5.0F * best.v + branch, branch) * unit(3.0F * best.v);
    const float share = unit(best.v / channel.to);
    const float broad = 1.7F - 1.0F * share;  // units
    const float d = (best.e - way) * best.width / broad;
    const float left = 1.0F - smoothstep(0.75F, 1.0F, best.v / channel.to);
    if (std::abs(d) < 1.0F && left > 0.0F) {
      const float groove = 1.0F - d * d;
      across += left * channel_depth * 2.0F * d * groove;
      tone -= 0.17F * left * groove;
    } else if (std::abs(d) < 2.0F && left > 0.0F) {
      const float levee = 1.0F - square(2.0F * (std::abs(d) - 1.5F));
      across -= left * 0.5F * channel_depth * (d > 0.0F ? 1.0F : -1.0F) * levee;
      tone += 0.07F * left * levee;
    }
    // The deposit below a channel is fresh and light.
    const float lobe = (best.e - way) * best.width / (3.0F + 5.0F * share);
    const float fresh = smoothstep(0.15F, 0.7F, best.v / channel.to) *
                        (1.0F - smoothstep(0.02F, 0.2F, best.v - channel.to));
    if (std::abs(lobe) < 1.0F) tone += 0.14F * fresh * square(1.0F - lobe * lobe);
  }
  hit.slope = right * across;
  hit.overgrown = smoothstep(0.55F, 1.10F, best.v) -
                  0.16F * broken_noise(key, 0.16F * best.e * best.width - own,
                                       0.10F * best.v * cone.length - own) -
                  0.10F * broken_noise(key, 0.40F * best.e * best.width + own,
                                       0.22F * best.v * cone.length - own);
  hit.tone = tone + 0.07F + 0.10F * (smoothstep(0.05F, 0.8F, best.v) - 0.35F);
  return hit;
}

bool debris_covers(const DebrisHit& hit) {
  return hit.cone != nullptr && hit.along > 0.0F && hit.inside > 0.3F && hit.overgrown < 0.62F;
}

}  // namespace belvedere
