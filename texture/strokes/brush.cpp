#include "texture/strokes/brush.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/glm.hpp>
#include <numeric>
#include <optional>
#include <utility>

#include "base/math.h"
#include "base/parallel.h"
#include "base/pixel_rect.h"

namespace belvedere {
namespace {

// The origin of the paint on the pixels of one tile: the class with the thickest paint, the second
// most visible class, and the stroke on top. A layer of another class hides the paint below by its
// opacity, one of the same class adds to it; of three classes on one pixel the thinnest is dropped,
// of several strokes of one class all but the thickest.
class PaintRecord {
 public:
  // Starts from the current state of the painting: two classes with their shares, and one thick
  // layer where a stroke is on top. to_copy_from: as in SheetWindow. Without it paint of other
  // classes on water is not recorded: a brook overhung by grass is still one line.
  PaintRecord(const Painting& painting, const GuidanceBuffers& guidance, PixelRect tile,
              bool to_copy_from);

  // A stroke, number `number`, lays paint of opacity alpha on pixel x, y of the canvas.
  void cover(int x, int y, const Stroke& stroke, std::uint32_t number, float alpha);

  // Writes sources, under, under_share and strokes of the tile.
  void hand_back(Painting& painting) const;

 private:
  // The paint of one class on a pixel.
  struct Paint {
    std::uint32_t source;  // origin of its thickest stroke
    float share;           // 0…1; 0: none
    float source_share;    // … of that stroke alone
    void thin(float by);
    void add(std::uint32_t from, float alpha);
  };
  struct Layers {
    Paint top;
    Paint under;           // of the other class
    std::uint32_t stroke;  // number of the stroke on top
    float stroke_share;    // 0…1
  };

  const GuidanceBuffers& guidance_;
  PixelRect tile_;
  bool to_copy_from_;
  Grid<Layers> layers_;
};

PaintRecord::PaintRecord(const Painting& painting, const GuidanceBuffers& guidance, PixelRect tile,
                         bool to_copy_from)
    : guidance_(guidance),
      tile_(tile),
      to_copy_from_(to_copy_from),
      layers_(tile.x1 - tile.x0, tile.y1 - tile.y0) {
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const float under = static_cast<float>(painting.under_share(x, y)) / 255.F;
      layers_(x - tile.x0, y - tile.y0) = {
          .top = {painting.sources(x, y), 1.F - under, 1.F - under},
          .under = {painting.under(x, y), under, under},
          .stroke = painting.strokes(x, y),
          .stroke_share = 1.F};
    }
}

void PaintRecord::Paint::thin(float by) {
  share *= by;
  source_share *= by;
}

void PaintRecord::Paint::add(std::uint32_t from, float alpha) {
  share += alpha;
  if (alpha < source_share) return;
  source = from;
  source_share = alpha;
}

void PaintRecord::cover(int x, int y, const Stroke& stroke, std::uint32_t number, float alpha) {
  Layers& here = layers_(x - tile_.x0, y - tile_.y0);
  here.stroke_share *= 1.F - alpha;
  if (alpha > here.stroke_share) {
    here.stroke = number;
    here.stroke_share = alpha;
  }
  if (!to_copy_from_ && guidance_.land_cover(x, y) == LandCoverClass::water) return;
  const LandCoverClass paint = guidance_.land_cover[stroke.source];
  here.top.thin(1.F - alpha);
  here.under.thin(1.F - alpha);
  if (guidance_.land_cover[here.top.source] == paint) {
    here.top.add(stroke.source, alpha);
    return;
  }
  if (here.under.share > 0.F && guidance_.land_cover[here.under.source] == paint)
    here.under.add(stroke.source, alpha);
  else if (alpha > here.under.share)
    here.under = {stroke.source, alpha, alpha};
  if (here.under.share > here.top.share) std::swap(here.top, here.under);
}

void PaintRecord::hand_back(Painting& painting) const {
  for (int y = tile_.y0; y < tile_.y1; ++y)
    for (int x = tile_.x0; x < tile_.x1; ++x) {
      const Layers& here = layers_(x - tile_.x0, y - tile_.y0);
      const auto own = static_cast<std::uint32_t>(painting.sources.index(x, y));
      const bool is_own =
          !to_copy_from_ && guidance_.land_cover[own] == guidance_.land_cover[here.top.source];
      painting.sources[own] = is_own ? own : here.top.source;
      const float known =
          here.top.share + here.under.share;  // > 0: the layers of the two thickest classes
      const auto share = static_cast<std::uint8_t>(std::lround(255.F * here.under.share / known));
      painting.under[own] = share > 0 ? here.under.source : own;
      painting.under_share[own] = share;
      painting.strokes[own] = here.stroke;
    }
}

constexpr int tile_px = 128;
constexpr float beyond_bank =
    0.12F;  // share of the paint of dry ground that extends over mapped water
constexpr float beyond_facet = 0.2F;  // share of the paint that crosses the edge of a plane of rock
constexpr float dry_from = 0.5F;      // share of the stroke after which the brush runs dry
constexpr float pressed_by = 0.18F;   // share of the stroke over which the brush is pressed on
constexpr float load_value = 0.04F;   // ±, encoded sRGB: how much lighter or darker …
constexpr float load_warmth =
    0.03F;  // … and warmer or cooler a load of paint is than the requested colour
// A stroke carries the colour of its starting point. Where that differs from the colour of the
// ground under it by more than this in a channel, it is brought near: across a field or a shadow it
// would glare.
constexpr float max_off_ground = 0.07F;
constexpr float ridge_light = 0.05F;  // encoded sRGB, of a ridge of paint

// A cheap 32-bit hash: it is called millions of times for bristles.
std::uint32_t hash32(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  return x ^ (x >> 16);
}

// One-dimensional value noise 0…1: hairs across the brush, wobble along it.
float hair_noise(float x, std::uint32_t seed) {
  const float base = std::floor(x);
  const auto i = static_cast<std::uint32_t>(static_cast<std::int32_t>(base));
  const float t = smoothstep(x - base);
  const auto at = [&](std::uint32_t k) {
    return static_cast<float>(hash32(k * 374761393U + seed) & 0xffffU) / 65535.F;
  };
  const float a = at(i);
  return a + (at(i + 1U) - a) * t;
}

// The hairs of a brush. Fine ones are visible only where a unit has enough pixels; downsampled to a
// size where they are not, a stroke looks the same, because the number of hairs that touch does not
// change.
struct Hairs {
  explicit Hairs(float pixels_per_unit)
      : fine(0.5F * std::clamp((pixels_per_unit - 1.5F) / 3.F, 0.F, 1.F)),
        contrast(std::clamp(2.F * pixels_per_unit, 1.F, 9.F)) {}
  // 0…1, about .5 ± .15: length of the hair that passes a position, in units across and along the
  // stroke.
  float height(float across, float along, std::uint32_t seed) const {
    const float coarse = hair_noise(across * 0.6F + 50.F, seed) * 0.6F +
                         hair_noise(across * 1.3F + along * 0.05F + 90.F, seed + 7U) * 0.4F;
    return fine > 0.F
               ? coarse +
                     fine * (hair_noise(across * 4.F + along * 0.03F + 70.F, seed + 11U) - 0.5F)
               : coarse;
  }
  float fine;
  float contrast;
};

// exp(-x⁴) as (1 - x⁴/8)^8: products only, so that the result does not depend on the machine's
// exp(). Flat for similar tones and steep beyond, so that a stroke ends at a shadow with an edge
// instead of fading into it.
float gate_bell(float x) {
  const float x2 = x * x;
  const float t = std::max(0.F, 1.F - x2 * x2 * 0.125F);
  const float t2 = t * t;
  const float t4 = t2 * t2;
  return t4 * t4;
}

glm::vec3 near_ground(const glm::vec3& paint, const glm::vec3& ground) {
  const glm::vec3 off = paint - ground;
  const float most = std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)});
  return most > max_off_ground ? ground + off * (max_off_ground / most) : paint;
}

// The pixels of the canvas inside `clip` that a stroke may touch; empty (x0 >= x1 or y0 >= y1) if
// there are none.
PixelRect bounds_of(const Stroke& stroke, glm::ivec2 origin, const PixelRect& clip) {
  glm::vec2 low = stroke.points[0];
  glm::vec2 high = low;
  for (int i = 1; i < stroke.point_count; ++i) {
    low = glm::min(low, stroke.points[static_cast<std::size_t>(i)]);
    high = glm::max(high, stroke.points[static_cast<std::size_t>(i)]);
  }
  const float reach =
      std::max(stroke.start_width, stroke.end_width) * 0.58F + 1.F;  // wobble widens by up to 7.5 %
  return {std::max(clip.x0, static_cast<int>(std::floor(low.x - reach)) - origin.x),
          std::max(clip.y0, static_cast<int>(std::floor(low.y - reach)) - origin.y),
          std::min(clip.x1, static_cast<int>(std::ceil(high.x + reach)) - origin.x),
          std::min(clip.y1, static_cast<int>(std::ceil(high.y + reach)) - origin.y)};
}

// A pixel's position relative to the stroke: the plain distance, and along and across in pixels.
// Before the start and beyond the end of the stroke `along` continues (below 0, above the length)
// and `beyond` is true.
struct StrokePosition {
  float distance;
  float along_px;
  float across_px;
  bool beyond;
};

StrokePosition place_on(const Stroke& stroke,
                        const std::array<float, Stroke::max_points>& length_before,
                        glm::vec2 pixel) {
  float best = 1e30F;
  StrokePosition position{};
  for (int i = 0; i + 1 < stroke.point_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const glm::vec2 segment = stroke.points[k + 1] - stroke.points[k];
    const float squared = glm::dot(segment, segment) + 1e-6F;
    const glm::vec2 offset = pixel - stroke.points[k];
    const float whole = glm::dot(offset, segment) / squared;
    const float t = std::clamp(whole, 0.F, 1.F);
    const glm::vec2 error = offset - t * segment;
    const float distance = glm::dot(error, error);
    if (distance >= best) continue;
    best = distance;
    const float length = std::sqrt(squared);
    position.beyond = (whole < 0.F && i == 0) || (whole > 1.F && i + 2 == stroke.point_count);
    position.along_px = length_before[k] + (position.beyond ? whole : t) * length;
    position.across_px = (error.y * segment.x - error.x * segment.y) / length;
  }
  position.distance = std::sqrt(best);
  return position;
}

// The columns of a row of the canvas, within the bounds, that hold every pixel whose distance from
// the stroke's line is at most `distance`.
std::pair<int, int> columns_near(const Stroke& stroke, glm::ivec2 origin, int row, float distance,
                                 const PixelRect& bounds) {
  const float reach = distance + 1.F;  // no rounding may lose a pixel
  const float y = static_cast<float>(row + origin.y) + 0.5F;
  float low = 1e30F;
  float high = -1e30F;
  for (int i = 0; i + 1 < stroke.point_count; ++i) {
    const glm::vec2 a = stroke.points[static_cast<std::size_t>(i)];
    const glm::vec2 b = stroke.points[static_cast<std::size_t>(i) + 1];
    // The part of the segment between y - reach and y + reach.
    if (std::min(a.y, b.y) > y + reach || std::max(a.y, b.y) < y - reach) continue;
    const float rise = b.y - a.y;
    float from = 0.F;
    float to = 1.F;
    if (std::abs(rise) > 1e-3F) {
      const float t0 = (y - reach - a.y) / rise;
      const float t1 = (y + reach - a.y) / rise;
      from = std::clamp(std::min(t0, t1), 0.F, 1.F);
      to = std::clamp(std::max(t0, t1), 0.F, 1.F);
    }
    const float x0 = a.x + from * (b.x - a.x);
    const float x1 = a.x + to * (b.x - a.x);
    low = std::min({low, x0, x1});
    high = std::max({high, x0, x1});
  }
  if (low > high) return {bounds.x0, bounds.x0};
  return {std::max(bounds.x0, static_cast<int>(std::floor(low - reach)) - origin.x),
          std::min(bounds.x1, static_cast<int>(std::ceil(high + reach)) - origin.x)};
}

void paint_stroke(const Stroke& stroke, std::uint32_t number, const SheetWindow& window,
                  const PixelRect& clip, Painting& painting, PaintRecord* record, PaintParts* parts,
                  const GuidanceBuffers& guidance, float pixels_per_unit) {
  const glm::ivec2 origin = window.origin_px;
  const bool stays_ashore = window.waters_known && stroke.gate == StrokeGate::surface &&
                            !guidance.land_cover.empty() &&
                            guidance.land_cover[stroke.source] != LandCoverClass::water;
  Grid<glm::vec3>& canvas = painting.picture;
  float* const seen_ground =
      stroke.standing && !painting.seen_ground.empty() ? painting.seen_ground.data() : nullptr;
  float* const seen_overhead =
      stroke.standing && !painting.seen_overhead.empty() ? painting.seen_overhead.data() : nullptr;
  const Grid<glm::vec3>* const ground = stroke.part == PaintPart::ground ? window.ground : nullptr;
  const PixelRect bounds = bounds_of(stroke, origin, clip);
  std::array<float, Stroke::max_points> length_before{};
  float length = 0.F;
  for (int i = 0; i + 1 < stroke.point_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    length_before[k] = length;
    length += glm::length(stroke.points[k + 1] - stroke.points[k]);
  }
  const float unit = 1.F / pixels_per_unit;
  const float widest = std::max(stroke.start_width, stroke.end_width) * 0.54F +
                       0.5F;  // no pixel farther than this is touched
  const Hairs hairs(pixels_per_unit);
  glm::vec3 colour = stroke.colour;
  float ridge = 0.F;
  if (stroke.tip == StrokeTip::hairs) {
    // Every load of paint is mixed separately.
    const std::uint32_t load = hash32(stroke.seed);
    const float value =
        stroke.load * load_value * (static_cast<float>(load & 0xffffU) / 32767.5F - 1.F);
    const float warmth =
        stroke.load * load_warmth * (static_cast<float>(load >> 16U) / 32767.5F - 1.F);
    colour += glm::vec3(value + warmth, value, value - warmth);
    ridge = stroke.load * ((stroke.seed & 0x100U) != 0U ? ridge_light : -ridge_light);
  }
  for (int y = bounds.y0; y < bounds.y1; ++y) {
    const auto [first, end] = columns_near(stroke, origin, y, widest, bounds);
    for (int x = first; x < end; ++x) {
      const std::size_t i = canvas.index(x, y);
      const float depth = guidance.depth_m[i];
      switch (stroke.gate) {
        case StrokeGate::surface:
          if (depth < stroke.depth_m * (1.F - stroke.depth_tolerance) ||
              depth > stroke.depth_m * (1.F + stroke.depth_tolerance))
            continue;
          break;
        case StrokeGate::same_class:
          if (guidance.land_cover[i] != guidance.land_cover[stroke.source]) continue;
          if (depth < stroke.depth_m * (1.F - stroke.depth_tolerance) ||
              depth > stroke.depth_m * (1.F + stroke.depth_tolerance))
            continue;
          break;
        case StrokeGate::upright:
          if (depth < stroke.depth_m * 0.985F) continue;
          break;
        case StrokeGate::sky:
          if (!guidance.is_sky(i)) continue;
          break;
        case StrokeGate::water:
          if (guidance.land_cover[i] != LandCoverClass::water) continue;
          break;
      }
      const glm::vec2 centre{static_cast<float>(x + origin.x) + 0.5F,
                             static_cast<float>(y + origin.y) + 0.5F};
      const StrokePosition position = place_on(stroke, length_before, centre);
      if (position.distance > widest) continue;
      const float share = std::clamp(position.along_px / (length + 1e-6F), 0.F, 1.F);
      float half_width =
          0.5F * (stroke.start_width + (stroke.end_width - stroke.start_width) * share);
      float alpha = stroke.alpha;
      float tint = 0.F;
      float outside = position.distance - half_width;  // px; negative inside
      if (stroke.tip == StrokeTip::hairs) {
        const float across = position.across_px * unit;
        const float along = position.along_px * unit;
        const float hair = hairs.height(across, along, stroke.seed);
        // Pressed on over its first part, slightly unevenly.
        const float set_down = std::max(0.F, 1.F - share / pressed_by);
        half_width *= (1.F - 0.35F * set_down * set_down) *
                      (1.F + 0.15F * (hair_noise(along * 0.3F, stroke.seed + 3U) - 0.5F));
        const float side = std::clamp(
            (stroke.edge > 0.F ? position.across_px : -position.across_px) / (half_width + 1e-3F),
            -1.F, 1.F);
        outside = position.distance - half_width;
        if (position.beyond) {
          // A flat brush ends in a shallow curve, each hair at its own position.
          const float reach = half_width * (0.75F * (1.F - side * side) + 0.9F * (hair - 0.5F));
          outside = std::max(std::abs(position.across_px) - half_width,
                             std::max(-position.along_px, position.along_px - length) - reach);
        }
        // Paint gathers in a ridge on one side and thins out on the other; towards the end the
        // brush runs dry.
        const float strength = std::abs(stroke.edge);
        tint = (hair - 0.5F) * stroke.wetness +
               ridge * strength * std::max(0.F, 1.F - std::abs(side - 0.7F) * 2.5F);
        const float late = std::max(0.F, share - dry_from) / (1.F - dry_from);
        alpha *= (1.F - 0.45F * strength * std::max(0.F, -side)) *
                 (1.F - (0.2F + 0.6F * stroke.bristle) * late * late);
        // Alpha is the share of hairs that touch: where hairs are visible some lay all their paint
        // and others none.
        alpha = std::clamp(alpha + stroke.bristle * hairs.contrast * (hair - 0.75F + 0.5F * alpha),
                           0.F, 0.97F);
      } else if (stroke.tip == StrokeTip::square && position.beyond) {
        outside = std::max(std::abs(position.across_px) - half_width,
                           std::max(-position.along_px, position.along_px - length));
      }
      // Antialiased by distance; a line thinner than a pixel keeps its area instead of its width.
      alpha *= std::clamp(0.5F - outside, 0.F, std::min(1.F, 2.F * half_width));
      if (alpha <= 0.F) continue;
      if (stroke.tone >= 0.F) {
        alpha *= gate_bell((guidance.tone[i] - stroke.tone) / stroke.tone_width);
      }
      if (stays_ashore && guidance.land_cover[i] == LandCoverClass::water) alpha *= beyond_bank;
      if (stroke.facet != 0 && guidance.rock_facet[i] != stroke.facet) alpha *= beyond_facet;
      if (alpha < 0.004F) continue;
      glm::vec3 paint = colour + tint;
      if (ground != nullptr && guidance.land_cover[i] == guidance.land_cover[stroke.source])
        paint = near_ground(paint, (*ground)[i]);
      canvas[i] += alpha * (paint - canvas[i]);
      if (seen_ground != nullptr) seen_ground[i] *= 1.F - alpha;
      if (seen_overhead != nullptr && stroke.depth_m < window.mapped->overhead_m[i])
        seen_overhead[i] *= 1.F - alpha;
      if (record != nullptr) record->cover(x, y, stroke, number, alpha);
      if (parts != nullptr) parts->cover(x, y, stroke.part, alpha, paint);
    }
  }
}

// Indices of strokes in painting order; of equal ones the first given is the first. Only indices
// are sorted, because strokes are large.
std::vector<std::uint32_t> by_order(const std::vector<Stroke>& strokes) {
  struct Ranked {
    float order;
    std::uint32_t number;
  };
  std::vector<Ranked> ranked;
  ranked.reserve(strokes.size());
  for (const Stroke& stroke : strokes)
    ranked.push_back({stroke.order, static_cast<std::uint32_t>(ranked.size())});
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Ranked& a, const Ranked& b) { return a.order > b.order; });
  std::vector<std::uint32_t> numbers;
  numbers.reserve(ranked.size());
  for (const Ranked& one : ranked) numbers.push_back(one.number);
  return numbers;
}

}  // namespace

Painting begin_painting(Grid<glm::vec3> canvas, bool recorded) {
  Painting painting{.picture = std::move(canvas),
                    .sources = {},
                    .under = {},
                    .under_share = {},
                    .strokes = {},
                    .seen_ground = {},
                    .seen_overhead = {}};
  if (!recorded) return painting;
  painting.sources = Grid<std::uint32_t>(painting.picture.width(), painting.picture.height());
  std::iota(painting.sources.begin(), painting.sources.end(), 0U);
  painting.under = painting.sources;
  painting.under_share = Grid<std::uint8_t>(painting.picture.width(), painting.picture.height(), 0);
  painting.strokes = Grid<std::uint32_t>(painting.picture.width(), painting.picture.height(), 0U);
  return painting;
}

void paint_in_order(Painting& painting, const GuidanceBuffers& guidance,
                    std::vector<Stroke> strokes, double pixels_per_unit, Progress& progress,
                    const SheetWindow& window, PaintParts* parts) {
  Grid<glm::vec3>& canvas = painting.picture;
  const std::uint32_t first_number = painting.stroke_count + 1;
  painting.stroke_count += static_cast<std::uint32_t>(strokes.size());
  const std::vector<std::uint32_t> ranked = by_order(strokes);
  const PixelRect asked =
      window.asked == PixelRect{} ? PixelRect{0, 0, canvas.width(), canvas.height()} : window.asked;
  const int across = (asked.width() + tile_px - 1) / tile_px;
  const int down = (asked.height() + tile_px - 1) / tile_px;
  std::vector<std::vector<std::uint32_t>> tiles(static_cast<std::size_t>(across) *
                                                static_cast<std::size_t>(down));
  for (std::size_t s = 0; s < strokes.size(); ++s) {
    const PixelRect b = bounds_of(strokes[ranked[s]], window.origin_px, asked);
    if (b.x0 >= b.x1 || b.y0 >= b.y1) continue;
    for (int ty = (b.y0 - asked.y0) / tile_px; ty <= (b.y1 - 1 - asked.y0) / tile_px; ++ty)
      for (int tx = (b.x0 - asked.x0) / tile_px; tx <= (b.x1 - 1 - asked.x0) / tile_px; ++tx)
        tiles[static_cast<std::size_t>(ty) * static_cast<std::size_t>(across) +
              static_cast<std::size_t>(tx)]
            .push_back(static_cast<std::uint32_t>(s));
  }
  progress.begin("painting strokes", static_cast<double>(tiles.size()));
  parallel_tiles(asked.width(), asked.height(), tile_px, [&](PixelRect part) {
    const auto t = static_cast<std::size_t>(part.y0 / tile_px) * static_cast<std::size_t>(across) +
                   static_cast<std::size_t>(part.x0 / tile_px);
    const PixelRect tile{asked.x0 + part.x0, asked.y0 + part.y0, asked.x0 + part.x1,
                         asked.y0 + part.y1};
    std::optional<PaintRecord> record;
    if (!painting.sources.empty()) record.emplace(painting, guidance, tile, window.to_copy_from);
    for (const std::uint32_t s : tiles[t])
      paint_stroke(strokes[ranked[s]], first_number + s, window, tile, painting,
                   record ? &*record : nullptr, parts, guidance,
                   static_cast<float>(pixels_per_unit));
    if (record) record->hand_back(painting);
    progress.advance(1.0);
  });
}

}  // namespace belvedere
