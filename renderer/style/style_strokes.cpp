#include "renderer/style/style_strokes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/grid_part.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

constexpr int tile_px = 64;
constexpr float taper = 0.55F;   // share of its width that a stroke loses towards its end
constexpr float bristle = 0.5F;  // variation of paint between its hairs
constexpr float hair_light = 0.02F;
constexpr float gate_hue_weight = 2.5F;
constexpr float bare_height = 0.4F;

// One straight piece of a stroke.
struct Piece {
  glm::vec2 from;
  glm::vec2 way;
  float per_square;  // 1 / length²
  float length;
  float along;  // length of the stroke before this piece
};

// A stroke prepared for painting.
struct Ready {
  std::array<Piece, StyleStroke::max_points - 1> pieces;
  int count = 0;
  float total = 0.0F;
  glm::vec2 low{1e9F};
  glm::vec2 high{-1e9F};

  explicit Ready(const StyleStroke& stroke) {
    for (int k = 0; k < stroke.count; ++k) {
      low = glm::min(low, stroke.points[static_cast<std::size_t>(k)]);
      high = glm::max(high, stroke.points[static_cast<std::size_t>(k)]);
    }
    for (int k = 0; k + 1 < stroke.count; ++k) {
      const glm::vec2 from = stroke.points[static_cast<std::size_t>(k)];
      const glm::vec2 way = stroke.points[static_cast<std::size_t>(k) + 1] - from;
      const float square = glm::dot(way, way) + 1e-9F;
      const float length = std::sqrt(square);
      pieces[static_cast<std::size_t>(count++)] = {from, way, 1.0F / square, length, total};
      total += length;
    }
  }
};

// A position relative to a stroke.
struct OnStroke {
  float square = 1e9F;  // squared distance to its centreline, px²
  float along = 0.0F;   // px
  float across = 0.0F;  // px, positive to the right
};

inline OnStroke find_on(const Ready& ready, glm::vec2 place) {
  OnStroke best;
  for (int k = 0; k < ready.count; ++k) {
    const Piece& piece = ready.pieces[static_cast<std::size_t>(k)];
    const glm::vec2 to = place - piece.from;
    const float share =
        std::clamp((to.x * piece.way.x + to.y * piece.way.y) * piece.per_square, 0.0F, 1.0F);
    const glm::vec2 off = to - share * piece.way;
    const float square = off.x * off.x + off.y * off.y;
    if (square >= best.square) continue;
    best.square = square;
    best.along = piece.along + share * piece.length;
    best.across = (off.y * piece.way.x - off.x * piece.way.y) / piece.length;
  }
  return best;
}

// Amount of paint of the hairs at `across`, -1…1 in half widths.
inline float hair_at(const StyleStroke& stroke, float across) {
  const float at = std::clamp(0.5F + 0.5F * across, 0.0F, 0.999F) * stroke.hair_count;
  const int k = static_cast<int>(at);
  float t = at - static_cast<float>(k);
  t = t * t * (3.0F - 2.0F * t);
  return stroke.hair[static_cast<std::size_t>(k)] * (1.0F - t) +
         stroke.hair[static_cast<std::size_t>(k) + 1] * t;
}

// Columns that the stroke may touch in the row of pixel centres at `y`.
inline bool columns_of(const Ready& ready, float y, float reach, float& x0, float& x1) {
  x0 = 1e9F;
  x1 = -1e9F;
  for (int k = 0; k < ready.count; ++k) {
    const Piece& piece = ready.pieces[static_cast<std::size_t>(k)];
    const float dy = y - piece.from.y;
    float from = 0.0F;
    float to = 1.0F;
    if (std::abs(piece.way.y) < 1e-4F) {
      if (std::abs(dy) > reach) continue;
    } else {
      const float a = (dy - reach) / piece.way.y;
      const float b = (dy + reach) / piece.way.y;
      from = std::max(std::min(a, b), 0.0F);
      to = std::min(std::max(a, b), 1.0F);
      if (from > to) continue;
    }
    const float left = piece.from.x + piece.way.x * from;
    const float right = piece.from.x + piece.way.x * to;
    x0 = std::min(x0, std::min(left, right) - reach);
    x1 = std::max(x1, std::max(left, right) + reach);
  }
  return x0 <= x1;
}

// Strokes do not cross borders of sky or water, nor jumps of distance.
inline bool may_paint(const StyleStroke& stroke, LandCoverClass id, float depth_m) {
  using enum LandCoverClass;
  if (id != stroke.id && (id == sky || stroke.id == sky || id == water || stroke.id == water))
    return false;
  return stroke.id == sky || (depth_m <= stroke.depth_m * (1.0F + stroke.farther) &&
                              depth_m >= stroke.depth_m * (1.0F - stroke.nearer));
}

// 1 where the ground has the colour at the seed, 0 where it differs: about exp(-x⁴).
inline float gate_at(const StyleStroke& stroke, const glm::vec3& ground) {
  const glm::vec3 apart = ground - stroke.ground;
  const float x2 = (apart.x * apart.x + gate_hue_weight * (apart.y * apart.y + apart.z * apart.z)) /
                   (stroke.gate * stroke.gate);
  float open = std::max(0.0F, 1.0F - x2 * x2 * 0.125F);
  open *= open;
  open *= open;
  return open * open;
}

void paint_stroke(const StyleStroke& stroke, const StyleWindow& window, PixelRect tile,
                  StyleCanvas& canvas, glm::ivec2 canvas_px) {
  const Ready ready(stroke);
  const float reach = stroke.half_width_px + 0.5F;
  const int y0 = std::max(
      tile.y0, stroke.pixel_px.y + static_cast<int>(std::floor(ready.low.y - reach - 0.5F)));
  const int y1 = std::min(
      tile.y1, stroke.pixel_px.y + static_cast<int>(std::ceil(ready.high.y + reach + 0.5F)));
  const glm::ivec2 origin = window.origin_px;
  for (int y = y0; y < y1; ++y) {
    const float at_y = static_cast<float>(y - stroke.pixel_px.y) + 0.5F;
    float left = 0.0F;
    float right = 0.0F;
    if (!columns_of(ready, at_y, reach, left, right)) continue;
    const int x0 = std::max(tile.x0, stroke.pixel_px.x + static_cast<int>(std::floor(left - 0.5F)));
    const int x1 = std::min(tile.x1, stroke.pixel_px.x + static_cast<int>(std::ceil(right + 0.5F)));
    for (int x = x0; x < x1; ++x) {
      const OnStroke on = find_on(ready, {static_cast<float>(x - stroke.pixel_px.x) + 0.5F, at_y});
      if (on.square > reach * reach) continue;
      const float distance = std::sqrt(on.square);
      const float gone = on.along / ready.total;
      const float half = stroke.half_width_px * (1.0F - taper * gone) *
                         (0.7F + 0.3F * std::min(1.0F, gone * 6.0F));
      const float cover =
          std::clamp(0.5F - (distance - half), 0.0F, 1.0F) * std::min(1.0F, 2.0F * half + 0.2F);
      if (cover <= 0.0F) continue;
      const std::size_t i = window.guidance.depth_m.index(x - origin.x, y - origin.y);
      const float depth_m = window.guidance.depth_m[i];
      const LandCoverClass id =
          window.guidance.is_sky(i) ? LandCoverClass::sky : window.guidance.land_cover[i];
      if (!may_paint(stroke, id, depth_m)) continue;
      const float hair = hair_at(stroke, on.across / stroke.half_width_px);
      const float alpha =
          std::min(0.97F, stroke.alpha * cover * gate_at(stroke, window.ground.smoothed[i]) *
                              (1.0F + bristle * (hair - 0.7F) * (0.5F + gone)));
      if (alpha <= 0.01F) continue;
      const std::size_t to = canvas.colour.index(x - canvas_px.x, y - canvas_px.y);
      glm::vec3 paint = stroke.colour;
      paint.x += hair_light * bristle * (hair - 0.5F);
      canvas.colour[to] += alpha * (paint - canvas.colour[to]);
      const float edge = distance / (stroke.half_width_px + 0.3F);
      const float ridge = (0.5F + 0.5F * hair) *
                          (0.6F + 0.4F * std::max(0.0F, 1.0F - edge * edge)) * (1.0F - 0.5F * gone);
      canvas.height[to] += alpha * (ridge - canvas.height[to]);
    }
  }
}

// The strokes that touch each tile of a rectangle, in painting order.
class Bins {
 public:
  Bins(const std::vector<StyleStroke>& strokes, PixelRect rect)
      : rect_(rect),
        across_((rect.width() + tile_px - 1) / tile_px),
        bins_(static_cast<std::size_t>(across_) *
              static_cast<std::size_t>((rect.height() + tile_px - 1) / tile_px)) {
    for (std::size_t k = 0; k < strokes.size(); ++k) {
      const PixelRect box = intersection(rect, touched(strokes[k]));
      if (box.empty()) continue;
      for (int v = (box.y0 - rect.y0) / tile_px; v <= (box.y1 - 1 - rect.y0) / tile_px; ++v)
        for (int u = (box.x0 - rect.x0) / tile_px; u <= (box.x1 - 1 - rect.x0) / tile_px; ++u)
          bin(u, v).push_back(static_cast<std::uint32_t>(k));
    }
  }
  const std::vector<std::uint32_t>& of(PixelRect tile) const {
    return bins_[static_cast<std::size_t>(tile.y0 / tile_px * across_ + tile.x0 / tile_px)];
  }

 private:
  static PixelRect touched(const StyleStroke& stroke) {
    const Ready ready(stroke);
    const float reach = stroke.half_width_px + 1.0F;
    const auto low = [&](float v) { return static_cast<int>(std::floor(v - reach)); };
    const auto high = [&](float v) { return static_cast<int>(std::ceil(v + reach)); };
    return moved({low(ready.low.x), low(ready.low.y), high(ready.high.x), high(ready.high.y)},
                 stroke.pixel_px.x, stroke.pixel_px.y);
  }
  std::vector<std::uint32_t>& bin(int u, int v) {
    return bins_[static_cast<std::size_t>(v * across_ + u)];
  }
  PixelRect rect_;
  int across_;
  std::vector<std::vector<std::uint32_t>> bins_;
};

}  // namespace

StyleCanvas paint_style_strokes(const Style& style, const StyleWindow& window,
                                const StylePaintParameters& parameters, PixelRect rect) {
  StyleCanvas canvas{
      part_of(window.ground.colour, moved(rect, -window.origin_px.x, -window.origin_px.y)),
      Grid<float>(rect.width(), rect.height(), bare_height)};
  const glm::ivec2 corner{rect.x0, rect.y0};
  const auto lay = [&](const std::vector<StyleStroke>& strokes) {
    const Bins bins(strokes, rect);
    parallel_tiles(rect.width(), rect.height(), tile_px, [&](PixelRect tile) {
      for (const std::uint32_t k : bins.of(tile))
        paint_stroke(strokes[k], window, moved(tile, rect.x0, rect.y0), canvas, corner);
    });
  };
  for (int layer = 0; layer < static_cast<int>(style_layers().size()); ++layer)
    lay(place_style_strokes(style, window, parameters, layer, rect));
  if (contour_strength(style, parameters) > 0.0)
    lay(place_contour_strokes(style, window, parameters, rect));
  return canvas;
}

}  // namespace belvedere
