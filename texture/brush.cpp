#include "texture/brush.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/glm.hpp>
#include <numeric>
#include <utility>

#include "renderer/base/parallel.h"
#include "texture/paint_record.h"

namespace belvedere {
namespace {

constexpr int tile_px = 128;
constexpr float tone_gate_width = 0.16F;  // look/recipe.md, finding 2: without it rock turns to fur

// A cheap 32-bit hash: bristles ask for it millions of times.
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
  float t = x - base;
  t = t * t * (3.F - 2.F * t);
  const auto at = [&](std::uint32_t k) { return static_cast<float>(hash32(k * 374761393U + seed) & 0xffffU) / 65535.F; };
  const float a = at(i);
  return a + (at(i + 1U) - a) * t;
}

// exp(-x²) as (1 - x²/8)^8: products only, so that no machine's exp() changes a bit.
float bell(float x) {
  const float t = std::max(0.F, 1.F - x * x * 0.125F);
  const float t2 = t * t;
  const float t4 = t2 * t2;
  return t4 * t4;
}

struct Bounds {
  int x0, y0, x1, y1;  // half open
};

Bounds bounds_of(const Stroke& stroke, int width, int height) {
  glm::vec2 low = stroke.points[0];
  glm::vec2 high = low;
  for (int i = 1; i < stroke.point_count; ++i) {
    low = glm::min(low, stroke.points[static_cast<std::size_t>(i)]);
    high = glm::max(high, stroke.points[static_cast<std::size_t>(i)]);
  }
  const float reach = std::max(stroke.start_width, stroke.end_width) * 0.58F + 1.F;  // wobble widens by up to 7.5 %
  return {std::max(0, static_cast<int>(std::floor(low.x - reach))), std::max(0, static_cast<int>(std::floor(low.y - reach))),
          std::min(width, static_cast<int>(std::ceil(high.x + reach))), std::min(height, static_cast<int>(std::ceil(high.y + reach)))};
}

// How far a pixel lies from the stroke: along (0…1 of the length, and in pixels), across, and the plain distance.
struct StrokePlace {
  float distance;
  float along_px;
  float across_px;
};

StrokePlace place_on(const Stroke& stroke, const std::array<float, Stroke::max_points>& length_before, glm::vec2 pixel) {
  float best = 1e30F;
  StrokePlace place{};
  for (int i = 0; i + 1 < stroke.point_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const glm::vec2 segment = stroke.points[k + 1] - stroke.points[k];
    const float squared = glm::dot(segment, segment) + 1e-6F;
    const glm::vec2 offset = pixel - stroke.points[k];
    const float t = std::clamp(glm::dot(offset, segment) / squared, 0.F, 1.F);
    const glm::vec2 error = offset - t * segment;
    const float distance = glm::dot(error, error);
    if (distance >= best) continue;
    best = distance;
    const float length = std::sqrt(squared);
    place.along_px = length_before[k] + t * length;
    place.across_px = (error.y * segment.x - error.x * segment.y) / length;
  }
  place.distance = std::sqrt(best);
  return place;
}

void paint_stroke(const Stroke& stroke, std::uint32_t number, const PixelRect& clip, Grid<glm::vec3>& canvas, PaintRecord& record,
                  const GuidanceBuffers& guidance, float pixels_per_unit) {
  const Bounds whole = bounds_of(stroke, canvas.width(), canvas.height());
  std::array<float, Stroke::max_points> length_before{};
  float length = 0.F;
  for (int i = 0; i + 1 < stroke.point_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    length_before[k] = length;
    length += glm::length(stroke.points[k + 1] - stroke.points[k]);
  }
  const float unit = 1.F / pixels_per_unit;
  for (int y = std::max(whole.y0, clip.y0); y < std::min(whole.y1, clip.y1); ++y) {
    for (int x = std::max(whole.x0, clip.x0); x < std::min(whole.x1, clip.x1); ++x) {
      const std::size_t i = canvas.index(x, y);
      const float depth = guidance.depth_m[i];
      switch (stroke.gate) {
        case StrokeGate::surface:
          if (depth < stroke.depth_m * (1.F - stroke.depth_tolerance) || depth > stroke.depth_m * (1.F + stroke.depth_tolerance)) continue;
          break;
        case StrokeGate::same_class:
          if (guidance.land_cover[i] != guidance.land_cover[stroke.source]) continue;
          if (depth < stroke.depth_m * (1.F - stroke.depth_tolerance) || depth > stroke.depth_m * (1.F + stroke.depth_tolerance)) continue;
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
      const StrokePlace place = place_on(stroke, length_before, {static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F});
      const float share = place.along_px / (length + 1e-6F);
      float half_width = 0.5F * (stroke.start_width + (stroke.end_width - stroke.start_width) * share);
      float cover = 1.F;
      float tint = 0.F;
      if (stroke.bristle > 0.F) {
        // Hairs at .9 and 1.7 per unit across the stroke, thinning to its end.
        const float across = place.across_px * unit;
        const float along = place.along_px * unit;
        const float hair = hair_noise(across * 0.9F + 50.F, stroke.seed) * 0.7F +
                           hair_noise(across * 1.7F + along * 0.05F + 90.F, stroke.seed + 7U) * 0.3F;
        cover = 1.F - stroke.bristle * std::max(0.F, hair - 0.45F + (share - 0.5F) * 0.5F * stroke.bristle) * 1.6F;
        tint = (hair - 0.5F) * stroke.wetness;
        half_width *= 1.F + 0.15F * (hair_noise(along * 0.3F, stroke.seed + 3U) - 0.5F);
      }
      // Antialiased by distance; a line thinner than a pixel keeps its area instead of its width.
      float alpha = std::clamp(half_width - place.distance + 0.5F, 0.F, std::min(1.F, 2.F * half_width));
      if (alpha <= 0.F) continue;
      alpha *= stroke.alpha * std::clamp(cover, 0.F, 1.F);
      if (stroke.tone >= 0.F) {
        alpha *= bell((guidance.tone[i] - stroke.tone) / tone_gate_width);
      }
      if (alpha < 0.004F) continue;
      canvas[i] += alpha * (stroke.colour + tint - canvas[i]);
      record.cover(x, y, stroke, number, alpha);
    }
  }
}

}  // namespace

Painting begin_painting(Grid<glm::vec3> canvas) {
  Painting painting{.picture = std::move(canvas), .sources = {}, .under = {}, .under_share = {}, .strokes = {}};
  painting.sources = Grid<std::uint32_t>(painting.picture.width(), painting.picture.height());
  std::iota(painting.sources.begin(), painting.sources.end(), 0U);
  painting.under = painting.sources;
  painting.under_share = Grid<std::uint8_t>(painting.picture.width(), painting.picture.height(), 0);
  painting.strokes = Grid<std::uint32_t>(painting.picture.width(), painting.picture.height(), 0U);
  return painting;
}

void paint_in_order(Painting& painting, const GuidanceBuffers& guidance, std::vector<Stroke> strokes, double pixels_per_unit,
                    Progress& progress) {
  Grid<glm::vec3>& canvas = painting.picture;
  const std::uint32_t first_number = painting.stroke_count + 1;
  painting.stroke_count += static_cast<std::uint32_t>(strokes.size());
  std::stable_sort(strokes.begin(), strokes.end(), [](const Stroke& a, const Stroke& b) { return a.order > b.order; });
  const int across = (canvas.width() + tile_px - 1) / tile_px;
  const int down = (canvas.height() + tile_px - 1) / tile_px;
  std::vector<std::vector<std::uint32_t>> tiles(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
  for (std::size_t s = 0; s < strokes.size(); ++s) {
    const Bounds b = bounds_of(strokes[s], canvas.width(), canvas.height());
    if (b.x0 >= b.x1 || b.y0 >= b.y1) continue;
    for (int ty = b.y0 / tile_px; ty <= (b.y1 - 1) / tile_px; ++ty)
      for (int tx = b.x0 / tile_px; tx <= (b.x1 - 1) / tile_px; ++tx)
        tiles[static_cast<std::size_t>(ty) * static_cast<std::size_t>(across) + static_cast<std::size_t>(tx)].push_back(
            static_cast<std::uint32_t>(s));
  }
  progress.begin("painting strokes", static_cast<double>(tiles.size()));
  parallel_tiles(canvas.width(), canvas.height(), tile_px, [&](PixelRect tile) {
    const auto t =
        static_cast<std::size_t>(tile.y0 / tile_px) * static_cast<std::size_t>(across) + static_cast<std::size_t>(tile.x0 / tile_px);
    PaintRecord record(painting, guidance, tile);
    for (const std::uint32_t s : tiles[t])
      paint_stroke(strokes[s], first_number + s, tile, canvas, record, guidance, static_cast<float>(pixels_per_unit));
    record.hand_back(painting);
    progress.advance(1.0);
  });
}

}  // namespace belvedere
