// Position, path and colour of the strokes of a style.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/srgb.h"
#include "renderer/style/stroke_direction.h"
#include "renderer/style/style_strokes.h"

namespace belvedere {
namespace {

constexpr float lightness_jitter = 0.9F;
constexpr float hue_jitter = 1.6F;
constexpr float sky_hue_jitter = 0.6F;  // of that
constexpr float swirl_hue_jitter = 0.8F;
constexpr double swirl_strength = 1.6;  // a sky has no forms that strong strokes could hide
constexpr double sky_length = 1.6;
constexpr double tree_length = 0.7;
constexpr double tree_width = 0.9;
constexpr double far_shortening = 0.4;  // of strokes on the most distant ground
constexpr double min_length_px = 2.5;
constexpr double min_width_px = 0.9;
constexpr double min_spacing_px = 1.6;    // denser strokes cannot be distinguished
constexpr double max_length_share = 1.4;  // of the mean: 0.6 … 1.4
constexpr double max_width_share = 1.35;  // 0.65 … 1.35
// Tones that separate shade, middle and light, each with residuals of its own.
constexpr std::array<double, 2> tone_thirds = {0.43, 0.75};
constexpr double third_softness = 0.08;
constexpr float accent_hue = 0.75F;
constexpr float accent_lightness = 0.3F;
constexpr float accent_nearness = 0.16F;
constexpr double gate_at_rest = 0.075;
// Hairs across a stroke per px of the painting.
constexpr double hairs_per_px = 1.9;

// Draw numbers of a stroke's cell.
enum Draw : std::uint64_t {
  at_x,
  at_y,
  kept,
  long_by,
  wide_by,
  turned,
  third,
  residual,
  accented,
  accent,
  ordered,
  first_hair
};

// The brush of a layer for one class; lengths in px of the sheet.
struct LayerBrush {
  StyleBrushwork brushwork;
  double length_px = 0.0;
  double width_px = 0.0;
  double wander_rad = 0.0;
  double spacing_px = 1.0;
  float hair_count = 1.0F;
  glm::vec3 jitter{0.0F};
};

double fitted_length_px(const Style& style, const StylePaintParameters& parameters,
                        LandCoverClass id, const StyleBrushwork& brushwork) {
  const double px = brushwork.length_px * sheet_px_per_painting_px(style, parameters);
  const double share = id == LandCoverClass::sky      ? sky_length
                       : id == LandCoverClass::forest ? tree_length
                                                      : 1.0;
  return std::max(px, min_length_px) * share;
}

double fitted_width_px(const Style& style, const StylePaintParameters& parameters,
                       LandCoverClass id, const StyleBrushwork& brushwork) {
  const double px = brushwork.width_px * sheet_px_per_painting_px(style, parameters);
  return std::max(px, 1.1) * (id == LandCoverClass::forest ? tree_width : 1.0);
}

using LayerBrushes = std::array<LayerBrush, land_cover_class_count>;

LayerBrushes layer_brushes(const Style& style, const StylePaintParameters& parameters,
                           const StyleLayer& layer) {
  const double max_deviation = std::clamp(0.018 + 0.03 * style.broken, 0.018, 0.05);
  LayerBrushes brushes;
  for (const LandCoverClassInfo& row : land_cover_classes()) {
    LayerBrush& brush = brushes[static_cast<std::size_t>(row.id)];
    brush.brushwork = brushwork_of(style, row.id);
    const StyleBrushwork& b = brush.brushwork;
    if (!(b.length_px > 0.0)) continue;
    const double length = fitted_length_px(style, parameters, row.id, b);
    const double width = fitted_width_px(style, parameters, row.id, b);
    brush.length_px = layer.length * length;
    brush.width_px = std::max(layer.width * width, min_width_px);
    brush.spacing_px = std::max(layer.spacing * std::sqrt(0.5 * length * width), min_spacing_px);
    brush.wander_rad = 0.10 + 0.35 * (1.0 - std::min(1.0, b.coherence / 0.7));
    brush.hair_count = static_cast<float>(
        std::clamp(layer.width * b.width_px * hairs_per_px, 1.0, StyleStroke::hairs - 1.0));
    const bool sky = row.id == LandCoverClass::sky;
    const bool swirls = sky && has_swirls(b);
    const double held = std::min(1.0, (swirls ? swirl_strength : 1.0) * max_deviation /
                                          std::max(b.lightness_deviation, 1e-4));
    const auto share = static_cast<float>(held * layer.jitter);
    const float hue = hue_jitter * (swirls ? swirl_hue_jitter : sky ? sky_hue_jitter : 1.0F);
    brush.jitter = share * glm::vec3(lightness_jitter, hue, hue);
  }
  return brushes;
}

// Side of the cells, px, each with one seed: small enough for the densest strokes, but at least 0.6
// of the mean spacing. Classes with longer strokes use only part of the cells.
double cell_px_of(const LayerBrushes& brushes) {
  double min_spacing = 0.0;
  double sum = 0.0;
  int count = 0;
  for (const LayerBrush& brush : brushes) {
    if (!(brush.length_px > 0.0)) continue;
    min_spacing = count == 0 ? brush.spacing_px : std::min(min_spacing, brush.spacing_px);
    sum += brush.spacing_px;
    ++count;
  }
  return count == 0 ? 0.0 : std::max({min_spacing, 0.6 * sum / count, min_spacing_px});
}

glm::vec2 turned_by(glm::vec2 v, glm::vec2 turn) {
  return {v.x * turn.x - v.y * turn.y, v.x * turn.y + v.y * turn.x};
}

// Places the strokes of one layer in a window.
struct Placer {
  const StyleWindow& window;
  const StylePaintParameters& parameters;
  const StyleLayer& layer;
  LayerBrushes brushes;
  double cell_px;
  std::uint64_t seed;
  float gate;
  double uneven;  // deviation of log2 of the jitter between regions of the ground
  std::uint64_t region_seed;

  // Factor on the jitter at a pixel of the sheet.
  float region_factor(glm::ivec2 sheet_px) const {
    if (uneven == 0.0) return 1.0F;
    const double noise =
        gaussian_noise(region_seed, (sheet_px.x + 0.5) / parameters.pixels_per_unit,
                       (sheet_px.y + 0.5) / parameters.pixels_per_unit, style_region_units);
    return static_cast<float>(
        exact::exp(std::numbers::ln2 * uneven * std::clamp(noise, -1.5, 1.5)));
  }

  bool at(glm::ivec2 sheet_px, std::size_t& index) const {
    const glm::ivec2 in = sheet_px - window.origin_px;
    if (!window.guidance.depth_m.contains(in.x, in.y)) return false;
    index = window.guidance.depth_m.index(in.x, in.y);
    return true;
  }

  // Traces the path from the seed in both directions along the field of stroke directions.
  void trace(StyleStroke& stroke, glm::vec2 seed_at, float length_px, float turn_rad) const {
    const int steps = std::clamp(static_cast<int>(length_px / 5.0F) + 1, 1, 4);
    const float step = length_px / static_cast<float>(2 * steps);
    const exact::Turn exactly = exact::turn(turn_rad);
    const glm::vec2 turn(static_cast<float>(exactly.cosine), static_cast<float>(exactly.sine));
    std::array<glm::vec2, StyleStroke::max_points> path{};
    int low = steps;
    int high = steps;
    path[static_cast<std::size_t>(steps)] = seed_at;
    for (const int way : {-1, 1}) {
      glm::vec2 place = seed_at;
      std::size_t i = 0;
      at(stroke.pixel_px, i);
      glm::vec2 heading = static_cast<float>(way) * turned_by(window.ground.along[i], turn);
      for (int k = 0; k < steps; ++k) {
        place += step * heading;
        const glm::ivec2 here = stroke.pixel_px + glm::ivec2(static_cast<int>(std::floor(place.x)),
                                                             static_cast<int>(std::floor(place.y)));
        if (!at(here, i)) break;
        const int next = way > 0 ? ++high : --low;
        path[static_cast<std::size_t>(next)] = place;
        glm::vec2 field = turned_by(window.ground.along[i], turn);
        if (glm::dot(field, heading) < 0.0F) field = -field;
        heading = 0.35F * heading + 0.65F * field;
        heading /= std::max(std::sqrt(glm::dot(heading, heading)), 1e-6F);
      }
    }
    stroke.count = high - low + 1;
    for (int k = 0; k < stroke.count; ++k)
      stroke.points[static_cast<std::size_t>(k)] = path[static_cast<std::size_t>(low + k)];
  }

  glm::vec3 colour(const StyleStroke& stroke, const LayerBrush& brush, std::size_t i,
                   std::int64_t x, std::int64_t y) const {
    const auto draw = [&](Draw which) { return random_uniform(seed, x, y, which); };
    const glm::vec3 ground = window.ground.smoothed[i];
    const double tone = window.guidance.tone.empty() ? ground.x : window.guidance.tone[i];
    const double shifted = tone + third_softness * (2.0 * draw(third) - 1.0);
    const std::size_t part = shifted < tone_thirds[0] ? 0 : shifted < tone_thirds[1] ? 1 : 2;
    const float region = stroke.id == LandCoverClass::sky ? 1.0F : region_factor(stroke.pixel_px);
    glm::vec3 colour = ground;
    if (const auto& drawn = brush.brushwork.residuals[part]; !drawn.empty())
      colour += region * brush.jitter *
                drawn[random_index(static_cast<std::uint32_t>(drawn.size()), seed, x, y, residual)];
    const auto& accents = brush.brushwork.accents;
    if (accents.empty() || draw(accented) >= layer.accents) return colour;
    const glm::vec3 strong =
        accents[random_index(static_cast<std::uint32_t>(accents.size()), seed, x, y, accent)];
    if (std::abs(strong.x - ground.x) >= accent_nearness) return colour;
    return colour + glm::vec3(accent_lightness, accent_hue, accent_hue) * (strong - colour);
  }

  // The stroke of a cell, if it has one whose seed lies in `rect`.
  bool place(std::int64_t x, std::int64_t y, PixelRect rect, StyleStroke& stroke) const {
    const auto draw = [&](std::uint64_t which) { return random_uniform(seed, x, y, which); };
    const double seed_x = (static_cast<double>(x) + draw(at_x)) * cell_px;
    const double seed_y = (static_cast<double>(y) + draw(at_y)) * cell_px;
    const double pixel_x = std::floor(seed_x);
    const double pixel_y = std::floor(seed_y);
    stroke.pixel_px = {static_cast<int>(pixel_x), static_cast<int>(pixel_y)};
    if (stroke.pixel_px.x < rect.x0 || stroke.pixel_px.y < rect.y0 ||
        stroke.pixel_px.x >= rect.x1 || stroke.pixel_px.y >= rect.y1)
      return false;
    std::size_t i = 0;
    if (!at(stroke.pixel_px, i)) return false;
    stroke.id = window.guidance.is_sky(i) ? LandCoverClass::sky : window.guidance.land_cover[i];
    const LayerBrush& brush = brushes[static_cast<std::size_t>(stroke.id)];
    if (!(brush.length_px > 0.0) || draw(kept) >= square(cell_px / brush.spacing_px)) return false;
    const double far = stroke.id == LandCoverClass::sky
                           ? 0.0
                           : style_distance(parameters, window.guidance.depth_m[i]);
    const double length = brush.length_px * (1.0 - far_shortening * far) *
                          (0.6 + (max_length_share - 0.6) * draw(long_by));
    const double width = brush.width_px * (0.65 + (max_width_share - 0.65) * draw(wide_by));
    const double wander = brush.wander_rad * random_normal(seed, x, y, turned);
    trace(stroke, {static_cast<float>(seed_x - pixel_x), static_cast<float>(seed_y - pixel_y)},
          static_cast<float>(length), static_cast<float>(wander));
    if (stroke.count < 2) return false;
    stroke.half_width_px = static_cast<float>(0.5 * width);
    stroke.alpha = static_cast<float>(layer.alpha);
    stroke.hair_count = brush.hair_count;
    for (int k = 0; k < StyleStroke::hairs; ++k)
      stroke.hair[static_cast<std::size_t>(k)] =
          static_cast<float>(draw(first_hair + static_cast<std::uint64_t>(k)));
    stroke.ground = window.ground.smoothed[i];
    stroke.colour = colour(stroke, brush, i, x, y);
    stroke.gate = gate;
    stroke.depth_m = window.guidance.depth_m[i];
    stroke.order = random_bits(seed, x, y, ordered);
    return true;
  }
};

}  // namespace

const std::vector<StyleLayer>& style_layers() {
  static const std::vector<StyleLayer> layers = {
      {1.4, 1.4, 0.85, 1.3, 0.6, 1.0, 0.0},   // broad ground layer
      {1.5, 0.6, 0.80, 0.8, 1.4, 1.2, 0.05},  // filament layers, which dominate the look
      {1.3, 0.5, 0.75, 0.8, 1.8, 1.2, 0.05},
  };
  return layers;
}

std::vector<StyleStroke> place_style_strokes(const Style& style, const StyleWindow& window,
                                             const StylePaintParameters& parameters, int layer,
                                             PixelRect rect) {
  const StyleLayer& of = style_layers()[static_cast<std::size_t>(layer)];
  const Placer placer{
      .window = window,
      .parameters = parameters,
      .layer = of,
      .brushes = layer_brushes(style, parameters, of),
      .cell_px = cell_px_of(layer_brushes(style, parameters, of)),
      .seed =
          stream_seed(parameters.seed, Stream::style_strokes, static_cast<std::uint64_t>(layer)),
      .gate = static_cast<float>(of.gate * gate_at_rest * (1.0 + 0.25 * style.vapour)),
      .uneven = missing_unevenness(style, parameters),
      .region_seed = stream_seed(parameters.seed, Stream::style_contrasts)};
  if (!(placer.cell_px > 0.0)) return {};
  rect = intersection(grown(rect, style_seed_reach_px(style, parameters)),
                      {0, 0, parameters.sheet_px.x, parameters.sheet_px.y});
  if (rect.empty()) return {};
  const auto cell = [&](int px) { return static_cast<int>(std::floor(px / placer.cell_px)); };
  const int first = cell(rect.y0);
  std::vector<std::vector<StyleStroke>> rows(
      static_cast<std::size_t>(cell(rect.y1 - 1) - first + 1));
  parallel_rows(static_cast<int>(rows.size()), [&](int j) {
    StyleStroke stroke;
    for (int x = cell(rect.x0); x <= cell(rect.x1 - 1); ++x)
      if (placer.place(x, first + j, rect, stroke))
        rows[static_cast<std::size_t>(j)].push_back(stroke);
  });
  return in_order(rows);
}

std::vector<StyleStroke> in_order(const std::vector<std::vector<StyleStroke>>& rows) {
  std::size_t count = 0;
  for (const auto& row : rows) count += row.size();
  std::vector<StyleStroke> strokes;
  strokes.reserve(count);
  for (const auto& row : rows) strokes.insert(strokes.end(), row.begin(), row.end());
  std::sort(strokes.begin(), strokes.end(), [](const StyleStroke& a, const StyleStroke& b) {
    if (a.order != b.order) return a.order < b.order;
    return a.pixel_px.y != b.pixel_px.y ? a.pixel_px.y < b.pixel_px.y : a.pixel_px.x < b.pixel_px.x;
  });
  return strokes;
}

int style_seed_reach_px(const Style& style, const StylePaintParameters& parameters) {
  double reach = 0.0;
  for (const StyleLayer& layer : style_layers())
    for (const LandCoverClassInfo& row : land_cover_classes()) {
      const StyleBrushwork b = brushwork_of(style, row.id);
      if (!(b.length_px > 0.0)) continue;
      const double length = layer.length * fitted_length_px(style, parameters, row.id, b);
      const double width =
          std::max(layer.width * fitted_width_px(style, parameters, row.id, b), min_width_px);
      reach = std::max(reach, 0.5 * max_length_share * length + 0.5 * max_width_share * width);
    }
  return static_cast<int>(std::ceil(reach)) + 2 + contour_look_px(style, parameters);
}

int style_stroke_margin_px(const Style& style, const StylePaintParameters& parameters) {
  // The seed lies up to one reach from a painted pixel; the stroke may extend as far beyond it.
  return 2 * style_seed_reach_px(style, parameters) + contour_look_px(style, parameters) + 1;
}

}  // namespace belvedere
