// Dark strokes along silhouettes.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/math.h"
#include "base/parallel.h"
#include "base/random_streams.h"
#include "renderer/image/oklab.h"
#include "renderer/style/stroke_direction.h"
#include "renderer/style/style_strokes.h"

namespace belvedere {
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
