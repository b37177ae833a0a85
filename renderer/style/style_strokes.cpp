#include "renderer/style/style_strokes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/grid.h"
#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/srgb.h"
#include "renderer/style/stroke_direction.h"

// Dark strokes along silhouettes.

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

namespace {

// Relative steps of distance: below the first there is no silhouette; from the second on a line has
// full strength.
constexpr float min_step = 0.010F;
constexpr float full_step = 0.05F;
constexpr float along_ridge = 0.05F;  // a line may run nearer than its start by this share
constexpr double width_share = 0.8;   // of the class's strokes
constexpr double length_share = 1.3;
constexpr double min_contour_px = 1.1;
constexpr int steps_each_way = 3;
constexpr double look_units = 1.6;
constexpr float dark_share = 0.75F;  // share of the style's darkest colour in a line's colour
constexpr float line_alpha = 0.85F;
constexpr float open_gate = 1e3F;  // lines do not end at changes of colour

enum ContourDraw : std::uint64_t { cell_x, cell_y, length_by, width_by, line_order, line_hair };

// The darkest colour of the style's ground, OKLab.
glm::vec3 darkest_paint(const Style& style) {
  glm::vec3 darkest(0.25F, 0.0F, -0.02F);
  float min_lightness = 1.0F;
  for (const ClassPalette& of : style.palette.classes)
    for (const ClassPalette::Stop& stop : of.stops) {
      const glm::vec3 lab(to_oklab(stop.ramp[0]));
      if (lab.x >= min_lightness) continue;
      min_lightness = lab.x;
      darkest = lab;
    }
  return darkest;
}

struct ContourPlacer {
  const Style& style;
  const StyleWindow& window;
  const StylePaintParameters& parameters;
  std::uint64_t seed;
  int look_px;  // search radius for a silhouette and for its direction
  glm::vec3 dark;

  // Distance at a pixel of the sheet; infinite for sky, below 0 beyond the window.
  float depth(glm::ivec2 sheet_px) const {
    const glm::ivec2 in = sheet_px - window.origin_px;
    return window.guidance.depth_m.contains(in.x, in.y) ? window.guidance.depth_m(in.x, in.y)
                                                        : -1.0F;
  }

  // Strength of a line, 0…1, from the relative step of distance to the farthest neighbour.
  float strength(glm::ivec2 at) const {
    const float own = depth(at);
    if (!(own > 0.0F) || std::isinf(own)) return 0.0F;
    float farthest = own;
    for (const glm::ivec2 to :
         {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)})
      farthest = std::max(farthest, depth(at + to));
    return smoothstep(min_step, full_step, std::isinf(farthest) ? 1.0F : farthest / own - 1.0F);
  }

  // Direction of the silhouette of a surface at distance `own`: perpendicular to the mean offset of
  // the farther pixels around. 0 where there are none.
  glm::vec2 tangent(glm::ivec2 at, float own) const {
    glm::vec2 away(0.0F);
    for (int y = -look_px; y <= look_px; ++y)
      for (int x = -look_px; x <= look_px; ++x)
        if (x * x + y * y <= look_px * look_px &&
            depth(at + glm::ivec2(x, y)) > own * (1.0F + min_step))
          away += glm::vec2(static_cast<float>(x), static_cast<float>(y));
    const float length = std::sqrt(glm::dot(away, away));
    return length > 0.0F ? glm::vec2(-away.y, away.x) / length : glm::vec2(0.0F);
  }

  bool place(std::int64_t x, std::int64_t y, double cell_px, PixelRect rect,
             StyleStroke& stroke) const {
    const auto draw = [&](std::uint64_t which) { return random_uniform(seed, x, y, which); };
    const glm::ivec2 middle(
        static_cast<int>(std::floor((static_cast<double>(x) + draw(cell_x)) * cell_px)),
        static_cast<int>(std::floor((static_cast<double>(y) + draw(cell_y)) * cell_px)));
    if (middle.x < rect.x0 || middle.y < rect.y0 || middle.x >= rect.x1 || middle.y >= rect.y1)
      return false;
    // The strongest silhouette nearby; among equal ones the nearest.
    float strongest = 0.0F;
    int nearest = 0;
    for (int v = -look_px; v <= look_px; ++v)
      for (int u = -look_px; u <= look_px; ++u) {
        const float found = strength(middle + glm::ivec2(u, v));
        const int away = u * u + v * v;
        if (found < strongest || found <= 0.0F || (found == strongest && away >= nearest)) continue;
        strongest = found;
        nearest = away;
        stroke.pixel_px = middle + glm::ivec2(u, v);
      }
    if (strongest <= 0.0F) return false;
    return trace(stroke, strongest, draw(length_by), draw(width_by), x, y);
  }

  bool trace(StyleStroke& stroke, float strength_here, double long_by, double wide_by,
             std::int64_t x, std::int64_t y) const {
    const glm::ivec2 in = stroke.pixel_px - window.origin_px;
    const std::size_t i = window.guidance.depth_m.index(in.x, in.y);
    stroke.id = window.guidance.land_cover[i];
    stroke.depth_m = window.guidance.depth_m[i];
    const StyleBrushwork brushwork = brushwork_of(style, stroke.id);
    if (!(brushwork.length_px > 0.0)) return false;
    const double px = sheet_px_per_painting_px(style, parameters);
    const double length = length_share * brushwork.length_px * px * (0.6 + 0.8 * long_by);
    const double width = std::max(width_share * brushwork.width_px * px, min_contour_px) *
                         (0.65 + 0.7 * wide_by) * (0.5 + 0.5 * strength_here);
    const float step = static_cast<float>(length / (2 * steps_each_way));
    std::array<glm::vec2, StyleStroke::max_points> path{};
    int low = steps_each_way;
    int high = steps_each_way;
    path[static_cast<std::size_t>(low)] = glm::vec2(0.5F);
    const glm::vec2 first = tangent(stroke.pixel_px, stroke.depth_m);
    if (first == glm::vec2(0.0F)) return false;
    for (const int way : {-1, 1}) {
      glm::vec2 at(0.5F);
      glm::vec2 heading = static_cast<float>(way) * first;
      for (int k = 0; k < steps_each_way; ++k) {
        at += step * heading;
        path[static_cast<std::size_t>(way > 0 ? ++high : --low)] = at;
        glm::vec2 next = tangent(stroke.pixel_px + glm::ivec2(static_cast<int>(std::floor(at.x)),
                                                              static_cast<int>(std::floor(at.y))),
                                 stroke.depth_m);
        if (next == glm::vec2(0.0F)) break;
        if (glm::dot(next, heading) < 0.0F) next = -next;
        heading = next;
      }
    }
    stroke.count = high - low + 1;
    for (int k = 0; k < stroke.count; ++k)
      stroke.points[static_cast<std::size_t>(k)] = path[static_cast<std::size_t>(low + k)];
    stroke.half_width_px = static_cast<float>(0.5 * width);
    stroke.hair_count = 2.0F;
    for (int k = 0; k < StyleStroke::hairs; ++k)
      stroke.hair[static_cast<std::size_t>(k)] =
          static_cast<float>(random_uniform(seed, x, y, line_hair + static_cast<std::uint64_t>(k)));
    stroke.ground = window.ground.smoothed[i];
    const float share = dark_share * static_cast<float>(contour_strength(style, parameters));
    stroke.colour = stroke.ground + share * (dark - stroke.ground);
    stroke.alpha = line_alpha * strength_here * (0.4F + 0.6F * share);
    stroke.gate = open_gate;
    stroke.farther = min_step;
    stroke.nearer = along_ridge;
    stroke.order = random_bits(seed, x, y, line_order);
    return true;
  }
};

}  // namespace

int contour_look_px(const Style& style, const StylePaintParameters& parameters) {
  return contour_strength(style, parameters) > 0.0
             ? std::max(2, static_cast<int>(look_units * parameters.pixels_per_unit + 0.5))
             : 0;
}

std::vector<StyleStroke> place_contour_strokes(const Style& style, const StyleWindow& window,
                                               const StylePaintParameters& parameters,
                                               PixelRect rect) {
  const double px = sheet_px_per_painting_px(style, parameters);
  const int look_px = contour_look_px(style, parameters);
  const ContourPlacer placer{style,      window,
                             parameters, stream_seed(parameters.seed, Stream::style_contours),
                             look_px,    darkest_paint(style)};
  const double cell_px = std::max(2.0 * look_px, 2.0 * px);
  rect = intersection(grown(rect, style_seed_reach_px(style, parameters)),
                      {0, 0, parameters.sheet_px.x, parameters.sheet_px.y});
  if (rect.empty()) return {};
  const auto cell = [&](int at) { return static_cast<int>(std::floor(at / cell_px)); };
  const int first = cell(rect.y0);
  std::vector<std::vector<StyleStroke>> rows(
      static_cast<std::size_t>(cell(rect.y1 - 1) - first + 1));
  parallel_rows(static_cast<int>(rows.size()), [&](int j) {
    StyleStroke stroke;
    for (int x = cell(rect.x0); x <= cell(rect.x1 - 1); ++x)
      if (placer.place(x, first + j, cell_px, rect, stroke))
        rows[static_cast<std::size_t>(j)].push_back(stroke);
  });
  return in_order(rows);
}

}  // namespace belvedere
