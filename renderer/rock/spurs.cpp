#include "renderer/rock/spurs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/picture_filter.h"

namespace belvedere {
namespace {

using namespace spur_form;

// Spacing of the three sizes, mm of the sheet, before the band's and the kind's factor.
constexpr std::array<float, spur_sizes> spacing_mm = {17.6F, 6.0F, 2.24F};
constexpr double fall_sigma_units = 4.8;
constexpr float min_down = 0.5F;          // cosine for a fall line: 60° from straight down
constexpr float min_spur_down = 0.3153F;  // for a spur: 72°
constexpr float turn_sigma = 0.16F;       // rad, deviation of spurs from the fall line
constexpr float funnel_turn =
    0.30F;  // how far spurs diverge around a funnel, so that its gullies converge
constexpr float beyond_ramp = 0.9F;    // height that a large spur loses across a ramp
constexpr float beyond_parent = 0.4F;  // height that a spur loses across the border of a larger one
constexpr float tolerance_share = 0.003F;  // of the depth …
constexpr float tolerance_slope = 4.5F;    // … and metres a metre of ground
constexpr float ramp_cell_units = 64.0F;   // mean distance of ramps if every cell has one
constexpr float longest_ramp =
    0.60F;  // half length, in cells: no position is cut by one farther away than 1.5 times this

float largest_factor() {
  float max = 0.0F;
  for (const SpurBand& band : spur_band_table) max = std::max(max, band.factor);
  return max;
}

// A direction turned to within the angle of a cosine from straight down.
glm::vec2 held_down(glm::vec2 direction, float min_cosine) {
  const float length = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  if (length < 1e-3F) return {0.0F, 1.0F};
  direction /= length;
  if (direction.y >= min_cosine) return direction;
  const float aside = std::sqrt(1.0F - min_cosine * min_cosine);
  return {direction.x < 0.0F ? -aside : aside, min_cosine};
}

glm::ivec2 cell_of(glm::vec2 position, float spacing) {
  return {static_cast<int>(std::floor(position.x / spacing)),
          static_cast<int>(std::floor(position.y / spacing))};
}

// The side of a position relative to the nearest ramp that crosses its surface there.
struct RampSide {
  std::uint32_t id = 0;
  float below = 1e9F;
  float strength = 0.0F;
};
RampSide side_of_ramp(const RampCells& cells, glm::vec2 position, float depth_m) {
  RampSide side;
  const glm::ivec2 at = cell_of(position, ramp_cell_units) - cells.first;
  float nearest = 1e9F;
  for (int y = std::max(at.y - 1, 0); y <= std::min(at.y + 1, cells.count.y - 1); ++y)
    for (int x = std::max(at.x - 1, 0); x <= std::min(at.x + 1, cells.count.x - 1); ++x) {
      const Ramp& ramp =
          cells.ramps[static_cast<std::size_t>(y) * static_cast<std::size_t>(cells.count.x) +
                      static_cast<std::size_t>(x)];
      if (!ramp.cut || std::abs(depth_m - ramp.depth_m) > ramp.tolerance_m) continue;
      const glm::vec2 offset = position - ramp.position;
      const float along = offset.x * ramp.along.x + offset.y * ramp.along.y;
      const float below = offset.y * ramp.along.x - offset.x * ramp.along.y;
      if (std::abs(along) >= ramp.half_length || std::abs(below) >= nearest ||
          std::abs(below) > ramp.half_length)
        continue;
      nearest = std::abs(below);
      side = {ramp.id * 2U + (below > 0.0F ? 1U : 0U), below,
              1.0F - smoothstep(0.75F, 1.0F, std::abs(along) / ramp.half_length)};
    }
  return side;
}

Ramp cut_ramp(const SpurGround& ground, const RockKind& kind, glm::ivec2 cell) {
  const std::uint64_t key = stream_seed(ground.seed, Stream::rock_diagonals);
  std::uint64_t draws = 0;
  const auto uniform = [&] {
    return static_cast<float>(random_uniform(key, cell.x, cell.y, draws++));
  };
  Ramp ramp;
  ramp.position.x = (static_cast<float>(cell.x) + uniform()) * ramp_cell_units;
  ramp.position.y = (static_cast<float>(cell.y) + uniform()) * ramp_cell_units;
  const bool wanted = uniform() < 0.35F * kind.diagonals;
  const auto ppu = static_cast<float>(ground.pixels_per_unit);
  const int x = static_cast<int>(std::floor(ramp.position.x * ppu));
  const int y = static_cast<int>(std::floor(ramp.position.y * ppu));
  if (!wanted || !ground.wide.holds(x, y)) return ramp;
  const std::size_t i = ground.wide.index(x, y);
  if (ground.wide.seen.is_sky(i)) return ramp;
  ramp.cut = true;
  ramp.depth_m = ground.wide.seen.depth_m[i];
  const float metres_per_unit =
      ground.wide.seen.footprint_m[i] * ppu / static_cast<float>(ground.wide.factor);
  ramp.half_length = (0.35F + (longest_ramp - 0.35F) * uniform()) * ramp_cell_units;
  ramp.tolerance_m = 2.0F * metres_per_unit * ramp.half_length + tolerance_share * ramp.depth_m;
  // 24° to 50° from level, up to the left or to the right.
  const float rise = 0.45F + 0.75F * uniform();
  const float way = uniform() < 0.5F ? -1.0F : 1.0F;
  const float length = std::sqrt(1.0F + rise * rise);
  ramp.along = {1.0F / length, way * rise / length};
  ramp.id = static_cast<std::uint32_t>(random_bits(key, cell.x, cell.y, draws++)) | 1U;
  return ramp;
}

// The mean normal of the wall around a spur, from wide pixels of its own surface.
glm::vec3 wall_normal(const SpurGround& ground, const Spur& spur, float spacing) {
  const WideView& wide = ground.wide;
  const glm::vec2 aside{spur.fall.y, -spur.fall.x};
  const std::array<glm::vec2, 5> around = {{{0.0F, 0.0F},
                                            spur.fall * 0.3F,
                                            spur.fall * 0.8F,
                                            aside * 0.3F + spur.fall * 0.3F,
                                            aside * -0.3F + spur.fall * 0.3F}};
  glm::vec3 sum(0.0F);
  for (const glm::vec2 offset : around) {
    const glm::vec2 there = spur.position + offset * spacing;
    const auto ppu = static_cast<float>(ground.pixels_per_unit);
    const std::size_t i = wide.index(static_cast<int>(std::floor(there.x * ppu)),
                                     static_cast<int>(std::floor(there.y * ppu)));
    if (std::abs(wide.seen.depth_m[i] - spur.depth_m) <= spur.tolerance_m * 1.6F)
      sum += wide.seen.normal[i];
  }
  return glm::normalize(sum);
}

Spur grow_spur(const SpurGround& ground, const SpurField& field, int band, int size,
               glm::ivec2 cell) {
  const SpurCells& cells =
      field.bands[static_cast<std::size_t>(band)][static_cast<std::size_t>(size)];
  const std::uint64_t key = stream_seed(ground.seed, Stream::rock_spurs,
                                        static_cast<std::uint64_t>(band * spur_sizes + size));
  std::uint64_t draws = 0;
  const auto uniform = [&] {
    return static_cast<float>(random_uniform(key, cell.x, cell.y, draws++));
  };
  const auto between = [&](float low, float high) { return low + (high - low) * uniform(); };
  Spur spur;
  spur.position.x = (static_cast<float>(cell.x) + between(0.05F, 0.95F)) * cells.spacing;
  spur.position.y = (static_cast<float>(cell.y) + between(0.05F, 0.95F)) * cells.spacing;
  const auto ppu = static_cast<float>(ground.pixels_per_unit);
  const int x = static_cast<int>(std::floor(spur.position.x * ppu));
  const int y = static_cast<int>(std::floor(spur.position.y * ppu));
  if (!ground.wide.holds(x, y)) return spur;
  const std::size_t i = ground.wide.index(x, y);
  if (ground.wide.seen.is_sky(i)) return spur;
  spur.grown = true;
  spur.id = static_cast<std::uint32_t>(random_bits(key, cell.x, cell.y, draws++)) | 1U;
  spur.top = between(0.0F, size == 0 ? 0.9F : 0.75F);
  spur.flank[0] = between(0.7F, 1.6F);
  spur.flank[1] = between(0.7F, 1.6F);
  spur.length = between(0.5F, 1.5F);
  spur.foot = between(0.7F, 1.6F);
  spur.skew_foot = between(-0.35F, 0.35F);
  spur.skew_head = between(-0.35F, 0.35F);
  const float turn = turn_sigma * static_cast<float>(random_normal(key, cell.x, cell.y, draws++));
  spur.depth_m = ground.wide.seen.depth_m[i];
  const float metres_per_unit =
      ground.wide.seen.footprint_m[i] * ppu / static_cast<float>(ground.wide.factor);
  spur.tolerance_m =
      metres_per_unit * cells.spacing * tolerance_slope + tolerance_share * spur.depth_m;
  spur.fall = ground.fall[i];
  spur.normal = wall_normal(ground, spur, cells.spacing);
  const glm::vec2 aside(spur.fall.y, -spur.fall.x);
  const float step = 0.5F * static_cast<float>(funnel_sigma_units.x);
  const float leaning = funnel_at(ground.seed, spur.position + step * aside) -
                        funnel_at(ground.seed, spur.position - step * aside);
  spur.down = spur.fall + (turn - funnel_turn * leaning) * aside;
  spur.parent = side_of_ramp(field.ramps, spur.position, spur.depth_m).id;
  // Water runs off the crests of larger spurs.
  for (int larger = 0; larger < size; ++larger) {
    const SpurHit hit =
        highest_spur(field.bands[static_cast<std::size_t>(band)][static_cast<std::size_t>(larger)],
                     field.kind->slender, spur.position, spur.depth_m, spur.parent);
    spur.parent = hit.flank_id();
    if (hit.spur != nullptr) spur.down -= field.kind->feather * hit.slope;
  }
  spur.down = held_down(spur.down, min_spur_down);
  return spur;
}

}  // namespace

SpurHit highest_spur(const SpurCells& cells, float slender, glm::vec2 position, float depth_m,
                     std::uint32_t parent) {
  const SpurPeaks peaks = find_peaks(cells, slender, position, depth_m, parent);
  SpurHit best;
  if (peaks.best < 0) {
    best.over_next = 0.0F;
    return best;
  }
  const Spur& spur = cells.spurs[static_cast<std::size_t>(peaks.best)];
  best.spur = &spur;
  const glm::vec2 offset = (position - spur.position) * (1.0F / cells.spacing);
  const float v = (offset.x * spur.down.x + offset.y * spur.down.y) * slender;
  const float u = offset.x * spur.down.y - offset.y * spur.down.x;
  best.across = u;
  best.along = v;
  best.side = u > 0.0F ? 1 : 0;
  const bool right = best.side != 0;
  const float wide = std::abs(u);
  // Heads and feet are slanted and pointed: level ones would line up into horizontal bars.
  const float head = spur.skew_head * u - head_point * wide;
  const float tail = spur.length + spur.skew_foot * u + foot_point * wide;
  best.height = spur.top;
  float rise = 0.0F;   // of the height along
  float drift = 0.0F;  // of the height across, from the slant
  if (v < head) {
    best.part = SpurPart::head;
    best.height += head_rise * (v - head);
    rise = head_rise;
    drift = -head_rise * (spur.skew_head - (right ? head_point : -head_point));
  } else if (v < tail || tail < head) {
    best.height += back_rise * (v - head);
    rise = back_rise;
  } else {
    best.part = SpurPart::foot;
    best.height += back_rise * (tail - head) - spur.foot * (v - tail);
    rise = -spur.foot;
    drift = spur.foot * (spur.skew_foot + (right ? foot_point : -foot_point));
  }
  best.steepness =
      spur.flank[best.side] / (opening + opening_along * std::clamp(v, opening_from, opening_to));
  best.height -= best.steepness * wide;
  if (spur.parent != parent) best.height -= cells.lost_beyond;
  const float across = (right ? -best.steepness : best.steepness) + 0.7F * drift;
  best.slope = {across * spur.down.y + rise * spur.down.x,
                -across * spur.down.x + rise * spur.down.y};
  best.next_id = peaks.next < 0 ? 0U : cells.spurs[static_cast<std::size_t>(peaks.next)].id;
  best.over_next = best.height - peaks.next_height;
  return best;
}

float funnel_at(std::uint64_t seed, glm::vec2 position) {
  return static_cast<float>(
      gaussian_noise(stream_seed(seed, Stream::rock_funnels), static_cast<double>(position.x),
                     static_cast<double>(position.y), funnel_sigma_units.x, funnel_sigma_units.y));
}

int spur_band(float metres_per_mm) {
  int band = 0;
  while (band + 1 < spur_bands &&
         metres_per_mm >= spur_band_table[static_cast<std::size_t>(band)].up_to_m)
    ++band;
  return band;
}

float spur_spacing(const RockKind& kind, int size, int band) {
  return spacing_mm[static_cast<std::size_t>(size)] * units_per_mm * kind.size *
         spur_band_table[static_cast<std::size_t>(band)].factor;
}

Grid<glm::vec2> smooth_fall_lines(const WideView& wide, double pixels_per_unit, PixelRect wanted) {
  const GuidanceBuffers& seen = wide.seen;
  Grid<float> along[2] = {Grid<float>(seen.width(), seen.height(), 0.0F),
                          Grid<float>(seen.width(), seen.height(), 0.0F)};
  parallel_ranges(seen.fall_line.size(), std::size_t{1} << 15U,
                  [&](std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i != end; ++i) {
                      along[0][i] = seen.fall_line[i].x;
                      along[1][i] = seen.fall_line[i].y;
                    }
                  });
  const double sigma = fall_sigma_units * pixels_per_unit / wide.factor;
  for (Grid<float>& part : along) part = blur_on_surface(part, seen.depth_m, sigma, wanted);
  Grid<glm::vec2> fall(seen.width(), seen.height(), glm::vec2(0.0F, 1.0F));
  parallel_rows(std::max(wanted.height(), 0), [&](int row) {
    const int y = wanted.y0 + row;
    for (int x = wanted.x0; x < wanted.x1; ++x)
      fall(x, y) = held_down({along[0](x, y), along[1](x, y)}, min_down);
  });
  return fall;
}

int smooth_fall_reach(double pixels_per_unit, int factor) {
  return surface_reach_px(fall_sigma_units * pixels_per_unit / factor);
}

SpurField grow_spurs(const SpurGround& ground, const RockKind& kind, PixelRect rect,
                     const std::array<bool, spur_bands>& bands) {
  SpurField field;
  field.kind = &kind;
  float reach = 0.0F;
  for (int size = 0; size < spur_sizes; ++size)
    reach += (static_cast<float>(reach_up) + 1.0F) * spur_spacing(kind, size, 0);
  const auto ramp_cell = [&](int px, float units) {
    return static_cast<int>(
        std::floor((static_cast<float>(px / ground.pixels_per_unit) + units) / ramp_cell_units));
  };
  field.ramps.first = glm::ivec2(ramp_cell(rect.x0, -reach), ramp_cell(rect.y0, -reach)) - 1;
  field.ramps.count =
      glm::ivec2(ramp_cell(rect.x1, reach), ramp_cell(rect.y1, reach)) + 2 - field.ramps.first;
  for (int y = 0; y < field.ramps.count.y; ++y)
    for (int x = 0; x < field.ramps.count.x; ++x)
      field.ramps.ramps.push_back(cut_ramp(ground, kind, field.ramps.first + glm::ivec2(x, y)));
  for (int band = 0; band < spur_bands; ++band) {
    if (!bands[static_cast<std::size_t>(band)]) continue;
    for (int size = 0; size < spur_sizes; ++size) {
      SpurCells& cells =
          field.bands[static_cast<std::size_t>(band)][static_cast<std::size_t>(size)];
      cells.spacing = spur_spacing(kind, size, band);
      cells.lost_beyond = size == 0 ? beyond_ramp : beyond_parent;
      // Smaller spurs need the larger spur under them.
      float grown = 1.0F;
      for (int smaller = size + 1; smaller < spur_sizes; ++smaller)
        grown += (static_cast<float>(reach_up) + 1.0F) * spur_spacing(kind, smaller, band);
      const auto unit = [&](int px) { return static_cast<float>(px / ground.pixels_per_unit); };
      const glm::ivec2 low = cell_of({unit(rect.x0) - grown, unit(rect.y0) - grown}, cells.spacing);
      const glm::ivec2 high =
          cell_of({unit(rect.x1) + grown, unit(rect.y1) + grown}, cells.spacing);
      cells.first = low - glm::ivec2(reach_across, reach_up);
      cells.count = high - cells.first + glm::ivec2(reach_across + 1, reach_down + 1);
      std::vector<Spur> spurs(static_cast<std::size_t>(cells.count.x) *
                              static_cast<std::size_t>(cells.count.y));
      parallel_rows(cells.count.y, [&](int y) {
        for (int x = 0; x < cells.count.x; ++x)
          spurs[static_cast<std::size_t>(y) * static_cast<std::size_t>(cells.count.x) +
                static_cast<std::size_t>(x)] =
              grow_spur(ground, field, band, size, cells.first + glm::ivec2(x, y));
      });
      cells.spurs = std::move(spurs);
      cells.lanes = to_lanes(cells);
    }
  }
  return field;
}

double spur_margin_units(const RockKind& kind) {
  // Ramps that the farthest spurs depend on.
  double margin = 1.5 * static_cast<double>(longest_ramp * ramp_cell_units) + 2.0;
  for (int size = 0; size < spur_sizes; ++size)
    margin += (reach_up + 1.0) * static_cast<double>(spacing_mm[static_cast<std::size_t>(size)] *
                                                     units_per_mm * kind.size * largest_factor());
  return margin;
}

SpurHits find_spurs(const SpurField& field, int band, glm::vec2 position, float depth_m) {
  SpurHits hits;
  const RampSide side = side_of_ramp(field.ramps, position, depth_m);
  hits.below_ramp = side.below;
  hits.ramp_strength = side.strength;
  std::uint32_t parent = side.id;
  for (int size = 0; size < spur_sizes; ++size) {
    const auto k = static_cast<std::size_t>(size);
    hits[k] = highest_spur(field.bands[static_cast<std::size_t>(band)][k], field.kind->slender,
                           position, depth_m, parent);
    parent = hits[k].flank_id();
  }
  return hits;
}

float large_height(const SpurField& field, int band, glm::vec2 position, float depth_m) {
  return highest_spur(field.bands[static_cast<std::size_t>(band)][0], field.kind->slender, position,
                      depth_m, side_of_ramp(field.ramps, position, depth_m).id)
      .height;
}

}  // namespace belvedere
